# SPDX-License-Identifier: BSD-3-Clause
"""Pictures with matplotlib. Each function draws into `ax`, or into axes of its own, and returns the axes.

`source` is Results, with `step` (-1: the last one), or an Evolution, which shows where it is now."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, Iterator, List, Optional, Tuple, Union

import numpy as np

from ._errors import ArgumentError
from ._native import ffi, lib
from ._surfaces import surfaces
from .evolution import Evolution
from .results import Results
from .sets import Set

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Source = Union[Results, Evolution]
_STATES = {1: ("sticks", "tab:green"), 2: ("slips", "tab:red"), 3: ("unresolved", "tab:gray")}


def _axes(ax: Optional["Axes"], **options: Any) -> "Axes":
    if ax is not None:
        return ax
    import matplotlib.pyplot as pyplot

    return pyplot.subplots(subplot_kw=options or None, layout="constrained")[1]


def _evolution(source: Source, step: int) -> Evolution:
    """An evolution that is at a step of the source."""
    if isinstance(source, Results):
        source._replay.load(source._states[step])
        return source._replay
    if isinstance(source, Evolution):
        return source
    raise ArgumentError(f"source: found {type(source).__name__}, expected Results or an Evolution")


def _lines(source: Source, step: int, names: Optional[List[str]] = None) -> Iterator[Tuple[str, Dict[str, np.ndarray]]]:
    """The lines of a step with the arrays that pictures need; positions in the coordinates of the scene."""
    evolution = _evolution(source, step)
    for name in names or list(evolution.lines):
        line = evolution[name]
        yield name, {"position": line.position + line.origin, "state": line.state.copy(), "tension": line.tension.copy(),
                     "arc_length": line.arc_length.copy(), "friction_force": line.friction_force.copy(),
                     "friction_bound": line.friction_bound.copy()}


def _obstacles(source: Source, axes: Tuple[int, ...], ax: "Axes", step: int, lines: Any) -> None:
    """The obstacles in grey, behind the lines. Seen along an axis, planes and ground that face the viewer are left out."""
    from matplotlib.collections import PolyCollection

    places = np.concatenate([data["position"] for _, data in lines])
    for name, surface in surfaces(_evolution(source, step), places.min(0), places.max(0)):
        if len(axes) == 3:
            look: Dict[str, Any] = {"facecolor": "0.75", "edgecolor": "0.6", "alpha": 0.35, "linewidth": 0.2}
            x = np.moveaxis(surface.point, -1, 0)
            if surface.triangle is None:
                ax.plot_surface(*x, rstride=1, cstride=1, **look)  # type: ignore[attr-defined]
            else:
                ax.plot_trisurf(*x[:2], surface.triangle, x[2], **look)  # type: ignore[attr-defined]
            continue
        if surface.normal is not None and abs(np.delete(surface.normal, axes)[0]) > 0.5:
            continue
        seen = PolyCollection(surface.polygons(axes), facecolor="0.85", edgecolor="0.85", linewidth=0.8, zorder=0)
        seen.set_label(name)
        ax.add_collection(seen)


def _shape(source: Source, axes: Tuple[int, ...], ax: "Axes", step: int, by_tension: bool, obstacles: bool) -> None:
    """The lines, seen along an axis or in space, with the nodes that stick and slip."""
    from matplotlib import colormaps
    from matplotlib.collections import LineCollection

    lines = list(_lines(source, step))
    if obstacles:
        _obstacles(source, axes, ax, step, lines)
    most = max(data["tension"].max() for _, data in lines) or 1.0
    for k, (name, data) in enumerate(lines):
        x = data["position"][:, axes]
        ax.plot(*x.T, color=f"C{k}", label=name, linewidth=1)
        if by_tension and len(axes) == 2:
            pieces = LineCollection(list(np.stack([x[:-1], x[1:]], 1)), cmap="viridis", linewidth=2.5)
            pieces.set_array(data["tension"])
            pieces.set_clim(0, most)
            ax.add_collection(pieces)
        for state, (_, color) in _STATES.items():
            touching = (data["state"] == state).any(0)
            if touching.any():
                ax.plot(*x[touching].T, ".", color=color, markersize=3)
    if by_tension and len(axes) == 2:
        from matplotlib.cm import ScalarMappable
        from matplotlib.colors import Normalize

        ax.figure.colorbar(ScalarMappable(Normalize(0, most), colormaps["viridis"]), ax=ax, label="tension [N]")
    shown = {state for _, data in lines for state in np.unique(data["state"]) if state in _STATES}
    for state in sorted(shown):
        ax.plot([], [], ".", color=_STATES[state][1], label=_STATES[state][0])
    if len(lines) + len(shown) > 1:
        ax.legend(*_without_obstacles(ax), fontsize="small")
    for axis, place in zip(axes, "xyz"):
        getattr(ax, f"set_{place}label")(f"{'xyz'[axis]} [m]")


def _without_obstacles(ax: "Axes") -> Tuple[List[Any], List[str]]:
    """What the legend names: obstacles are grey, and speak for themselves."""
    from matplotlib.collections import PolyCollection

    shown = [(handle, label) for handle, label in zip(*ax.get_legend_handles_labels()) if not isinstance(handle, PolyCollection)]
    return [handle for handle, _ in shown], [label for _, label in shown]


def plan(source: Source, step: int = -1, ax: Optional["Axes"] = None, tension: bool = True, obstacles: bool = True) -> "Axes":
    """The lines from above, coloured by tension; nodes that stick are green, those that slip red. Obstacles are grey."""
    ax = _axes(ax)
    _shape(source, (0, 1), ax, step, tension, obstacles)
    ax.set_aspect("equal", "datalim")
    return ax


def elevation(source: Source, step: int = -1, ax: Optional["Axes"] = None, tension: bool = True, along: str = "x",
              obstacles: bool = True) -> "Axes":
    """The lines from the side, over x or y; heights to the same scale."""
    if along not in ("x", "y"):
        raise ArgumentError(f"along: found {along!r}, expected 'x' or 'y'")
    ax = _axes(ax)
    _shape(source, ("xy".index(along), 2), ax, step, tension, obstacles)
    ax.set_aspect("equal", "datalim")
    return ax


def view_3d(source: Source, step: int = -1, ax: Optional["Axes"] = None, obstacles: bool = True) -> "Axes":
    """The lines in space, and the obstacles as they are now: those without an end as far as the lines go; meshes as their
    triangles, without the radius about them."""
    ax = _axes(ax, projection="3d")
    _shape(source, (0, 1, 2), ax, step, False, obstacles)
    ax.set_aspect("equal")
    return ax


def tension(source: Source, step: int = -1, ax: Optional["Axes"] = None, lines: Optional[List[str]] = None) -> "Axes":
    """The tension along each line, from end A."""
    ax = _axes(ax)
    for name, data in _lines(source, step, lines):
        ax.stairs(data["tension"], data["arc_length"], label=name, baseline=None)
    ax.set_xlabel("length from end A [m]")
    ax.set_ylabel("tension [N]")
    ax.set_ylim(bottom=0)
    ax.legend(fontsize="small")
    return ax


def friction_use(source: Source, step: int = -1, ax: Optional["Axes"] = None, lines: Optional[List[str]] = None) -> "Axes":
    """The friction force over its bound at the nodes that touch with friction: 1 where a node slips."""
    ax = _axes(ax)
    for name, data in _lines(source, step, lines):
        force, bound = np.linalg.norm(data["friction_force"], axis=2), data["friction_bound"]
        touching = (bound > 0) & (data["state"] > 0)
        use = np.where(touching, force / np.where(touching, bound, 1), 0).max(0)
        some = touching.any(0)
        ax.plot(data["arc_length"][some], use[some], ".", label=name)
    ax.set_xlabel("length from end A [m]")
    ax.set_ylabel("friction force over its bound [-]")
    ax.set_ylim(-0.02, 1.05)
    ax.legend(fontsize="small")
    return ax


def _start(results: Results, line: str, at: int) -> Tuple[np.ndarray, Optional[np.ndarray]]:
    """Where an end is as the scene begins, and the force there; None of a static start, which is the first step itself, and
    where a table of stiffness gives it."""
    begun = results._replay.fresh()
    c, index, state = begun._c_scene, begun._index("lines", line), begun[line]
    view = lib.cps_evolution_line_view(begun._handle, index)
    position, first, given = state.position, c.line[index].start, c.line[index].end[at]
    place = position[-at] + state.origin
    if any(c.line[k].start.kind == lib.CPS_START_STATIC for k in range(c.line_count)):
        return place, None
    if given.kind != lib.CPS_END_KIND_HELD:
        return place, np.array(list(given.value))
    element = view.element_count - 1 if at else 0
    way = position[element + 1] - position[element]
    size = float(np.linalg.norm(way))
    strain = max(size / state.element_length[element] - 1, 0.0)
    if first.tension != ffi.NULL:
        tension = first.tension[element]
    elif view.compliance == 0 or strain == 0:
        tension = 0.0
    elif view.spring_count == 0 and not state.two_stiffnesses.exists:
        tension = strain / (view.compliance * state.compliance_factor[element])
    else:
        return place, None
    return place, (1 if at else -1) * tension / size * way


def hysteresis(results: Results, line: str, end: str = "B", direction: Any = None, ax: Optional["Axes"] = None) -> "Axes":
    """The force at an end over its displacement from where the scene begins, along a direction, by default that of
    the largest displacement."""
    at = "AB".index(end) if end in ("A", "B") else -1
    if at < 0:
        raise ArgumentError(f"end: found {end!r}, expected 'A' or 'B'")
    x, force = (np.array(values) for values in (results[line].end(end, "position"), results[line].end(end, "force")))
    start, pull = _start(results, line, at)
    if pull is None:
        x = x - start
    else:
        x, force = np.vstack([0 * start, x - start]), np.vstack([pull, force])
    if direction is None:
        far = x[np.argmax(np.linalg.norm(x, axis=1))]
        direction = far if np.linalg.norm(far) > 0 else [1.0, 0, 0]
    d = np.asarray(direction, float) / np.linalg.norm(direction)
    ax = _axes(ax)
    ax.plot(x @ d, force @ d, ".-", markersize=3, label=f"{line}.{end}")
    ax.set_xlabel(f"displacement along ({d[0]:.3g}, {d[1]:.3g}, {d[2]:.3g}) [m]")
    ax.set_ylabel("force [N]")
    ax.legend(fontsize="small")
    return ax


def plot_set(set: Set, ax: Optional["Axes"] = None, directions: int = 720, **style: Any) -> "Axes":
    """A bounded set of the plane, or of space, by its support points."""
    if not isinstance(set, Set) or set.space not in (2, 3):
        raise ArgumentError("set: expected a Set of 2 or 3 components")
    if set.space == 2:
        angle = np.linspace(0, 2 * np.pi, directions, endpoint=False)
        x = set.support_point(np.stack([np.cos(angle), np.sin(angle)], 1))
        ax = _axes(ax)
        ax.fill(*x.T, **{"alpha": 0.3, **style})
        ax.plot(*np.vstack([x, x[:1]]).T, color=style.get("color", "C0"), linewidth=1)
        ax.set_aspect("equal", "datalim")
        return ax
    count = max(int(np.sqrt(directions)), 12)
    azimuth, polar = np.meshgrid(np.linspace(0, 2 * np.pi, 2 * count), np.linspace(0, np.pi, count))
    w = np.stack([np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)], -1)
    space: Any = _axes(ax, projection="3d")
    space.plot_surface(*np.moveaxis(set.support_point(w), -1, 0), **{"alpha": 0.6, **style})
    space.set_aspect("equal")
    return space


def animate(results: Results, path: str, view: str = "elevation", fps: int = 10, **options: Any) -> str:
    """Write all steps as a GIF (with pillow), or as an MP4 where ffmpeg is installed. Returns the path."""
    from matplotlib import animation
    import matplotlib.pyplot as pyplot

    views = {"plan": plan, "elevation": elevation, "3d": view_3d}
    if view not in views:
        raise ArgumentError(f"view: found {view!r}, expected one of {', '.join(views)}")
    writer = "pillow" if path.lower().endswith(".gif") else "ffmpeg"
    if not animation.writers.is_available(writer):
        raise ArgumentError(f"{path}: the writer {writer} is not installed")
    figure, ax = pyplot.subplots(subplot_kw={"projection": "3d"} if view == "3d" else None)
    keep: Dict[str, Any] = {} if view == "3d" else {"tension": False}

    def draw(step: int) -> None:
        ax.clear()
        views[view](results, step=step, ax=ax, **keep, **options)
        ax.set_title(results.steps[step].name)

    animation.FuncAnimation(figure, draw, frames=len(results), init_func=lambda: None).save(path, writer=writer, fps=fps)
    pyplot.close(figure)
    return path
