# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces of obstacles, sampled for pictures in space."""
from __future__ import annotations

from typing import Any, Iterator, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from ._native import ffi, lib
from ._record import Record

AROUND = 48  # points round a circle
MOST_ALONG = 100  # points of ground along either axis
MOST_TRIANGLES = 20000
MARGIN = 0.15  # what has no end extends beyond the lines by this part of their extent


class Surface(NamedTuple):
    """Points in the coordinates of the scene [m]: (rows, columns, 3), or (vertices, 3) with triangles (count, 3)."""

    point: np.ndarray
    triangle: Optional[np.ndarray] = None
    normal: Optional[np.ndarray] = None  # of a plane or ground: away from it

    def polygons(self, axes: Sequence[int]) -> List[np.ndarray]:
        """What is seen of it in these axes: its faces, and its first and last row, as of a cylinder that is cut off."""
        x = self.point[..., axes]
        if self.triangle is not None:
            return list(x[self.triangle])
        return [*np.stack([x[:-1, :-1], x[1:, :-1], x[1:, 1:], x[:-1, 1:]], 2).reshape(-1, 4, len(axes)), x[0], x[-1]]


def surfaces(evolution: Any, low: np.ndarray, high: np.ndarray) -> Iterator[Tuple[str, Surface]]:
    """The obstacles where they are now; low, high: the box that the lines occupy [m]. Surfaces that are given as
    functions, and meshes of very many triangles, are left out."""
    for k, (name, now) in enumerate(evolution.obstacles.items()):
        found = _surface(evolution._c_scene.obstacle[k], now, low, high)
        if found is not None:
            yield name, found


def _surface(obstacle: Any, now: Record, low: np.ndarray, high: np.ndarray) -> Optional[Surface]:
    kind = obstacle.kind
    if kind == lib.CPS_OBSTACLE_SURFACE:
        return None
    if kind == lib.CPS_OBSTACLE_GROUND:
        return Surface(now.point + _ground(lib.cps_ground_grid(obstacle.ground)), normal=np.array([0.0, 0, 1]))
    axes = np.stack([now.side, np.cross(now.axis, now.side), now.axis])  # rows
    if kind == lib.CPS_OBSTACLE_MESH:
        return _mesh(lib.cps_mesh_triangles(obstacle.mesh), now.point, axes)
    if kind == lib.CPS_OBSTACLE_BOX:
        return Surface(now.point + _box(np.array(list(obstacle.shape.size)), obstacle.radius) @ axes)
    corners = np.stack(np.meshgrid(*zip(low, high)), -1).reshape(-1, 3)
    reach = (corners - now.point) @ axes.T
    margin = MARGIN * np.linalg.norm(high - low)
    begin, end = reach.min(0) - margin, reach.max(0) + margin
    if kind == lib.CPS_OBSTACLE_PLANE:
        a, b = np.meshgrid([begin[0], end[0]], [begin[1], end[1]])
        return Surface(now.point + np.stack([a, b, 0 * a], -1) @ axes, normal=now.axis)
    away, along = _profile(obstacle, begin[2], end[2])
    angle = np.linspace(0, 2 * np.pi, AROUND + 1)
    local = np.stack([np.outer(away, np.cos(angle)), np.outer(away, np.sin(angle)), np.outer(along, np.ones_like(angle))], -1)
    return Surface(now.point + local @ axes)


def _profile(obstacle: Any, begin: float, end: float) -> Tuple[np.ndarray, np.ndarray]:
    """What is round about an axis: distances from the axis, and places along it."""
    r, shape, kind = obstacle.radius, obstacle.shape, obstacle.kind
    if kind == lib.CPS_OBSTACLE_CYLINDER:
        return np.array([r, r]), np.array([begin, end])
    if kind == lib.CPS_OBSTACLE_TORUS:
        t = np.linspace(0, 2 * np.pi, AROUND // 2 + 1)
        return shape.main_radius + r * np.cos(t), r * np.sin(t)
    if kind == lib.CPS_OBSTACLE_CONE:  # the tip is the point, the axis goes into the cone
        t = np.linspace(0, np.pi / 2 - shape.angle, AROUND // 4 + 1)
        away, along = r * np.sin(t), r - r * np.cos(t)
        more = max(0.0, end - along[-1])
        return np.append(away, away[-1] + more * np.tan(shape.angle)), np.append(along, along[-1] + more)
    t = np.linspace(0, np.pi, AROUND // 2 + 1)  # sphere, capsule
    half = shape.length / 2 if kind == lib.CPS_OBSTACLE_CAPSULE else 0.0
    middle = len(t) // 2
    t = np.insert(t, middle, t[middle])
    return r * np.sin(t), r * np.cos(t) + half * np.where(np.arange(len(t)) <= middle, 1, -1)


def _box(size: np.ndarray, r: float) -> np.ndarray:
    """Round every corner an eighth of a ball; the faces lie between them."""
    quarter = np.linspace(0, np.pi / 2, AROUND // 8 + 1)
    azimuth = np.concatenate([quarter + k * np.pi / 2 for k in range(4)] + [[0.0]])
    quadrant = np.append(np.repeat(np.arange(4), len(quarter)), 0)
    polar = np.concatenate([quarter, quarter + np.pi / 2])
    up = np.where(np.arange(len(polar)) < len(quarter), 1, -1)
    sign_x, sign_y = np.where(np.isin(quadrant, (0, 3)), 1, -1), np.where(quadrant < 2, 1, -1)
    a, b, c = size / 2 - r
    x = sign_x * a + r * np.outer(np.sin(polar), np.cos(azimuth))
    y = sign_y * b + r * np.outer(np.sin(polar), np.sin(azimuth))
    z = np.outer(up * c + r * np.cos(polar), np.ones_like(azimuth))
    found = np.stack([x, y, z], -1)
    top, bottom = np.zeros_like(found[:1]), np.zeros_like(found[:1])  # the middles of the upper and of the lower face
    top[..., 2], bottom[..., 2] = size[2] / 2, -size[2] / 2
    return np.concatenate([top, found, bottom])


def _array(pointer: Any, count: int, dtype: Any) -> np.ndarray:
    return np.frombuffer(ffi.buffer(pointer, count * np.dtype(dtype).itemsize), dtype)


def _ground(grid: Any) -> np.ndarray:
    x, y = _array(grid.x, grid.x_count, np.float64), _array(grid.y, grid.y_count, np.float64)
    z = _array(grid.z, grid.x_count * grid.y_count, np.float64).reshape(grid.y_count, grid.x_count)
    i, j = (np.unique(np.linspace(0, n - 1, min(n, MOST_ALONG)).round().astype(int)) for n in z.shape)
    return np.stack([*np.meshgrid(x[j], y[i]), z[np.ix_(i, j)]], -1)


def _mesh(of: Any, point: np.ndarray, axes: np.ndarray) -> Optional[Surface]:
    if of.triangle_count > MOST_TRIANGLES:
        return None
    vertex = _array(of.vertex, 3 * of.vertex_count, np.float64).reshape(-1, 3)
    return Surface(point + vertex @ axes, _array(of.triangle, 3 * of.triangle_count, np.int32).reshape(-1, 3).copy())
