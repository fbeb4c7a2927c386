# SPDX-License-Identifier: BSD-3-Clause
"""Obstacles as polygons, for pictures: where they are now, as far as is seen about the lines."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Iterator, NamedTuple, Optional

import numpy as np

from ._native import ffi, lib

if TYPE_CHECKING:
    from .evolution import Evolution

_MANY = 20000  # triangles of a mesh, above which only those near the lines are drawn


class Shape(NamedTuple):
    name: str
    polygons: np.ndarray          # [m] (polygons, corners, 3) in the coordinates of the scene
    normal: Optional[np.ndarray]  # of a plane or ground: away from it


def shapes(evolution: "Evolution", low: np.ndarray, high: np.ndarray) -> Iterator[Shape]:
    """The obstacles of an evolution. What has no end is drawn about the box `low` .. `high` of the lines."""
    scene = evolution._c_scene
    for k, (name, report) in enumerate(evolution.obstacles.items()):
        obstacle = scene.obstacle[k]
        point, axis, side = report.point, report.axis, report.side
        frame = np.stack([side, np.cross(axis, side), axis])  # rows: the axes of the obstacle
        span = max(float(np.linalg.norm(high - low)), 1e-9)
        corners = np.array(np.meshgrid(*zip(low, high), indexing="ij")).reshape(3, -1).T
        local = (corners - point) @ frame.T
        kind, radius, shape = obstacle.kind, obstacle.radius, obstacle.shape
        normal = None
        if kind == lib.CPS_OBSTACLE_GROUND:
            yield Shape(name, _ground(obstacle, point, low, high, 0.1 * span), np.array([0.0, 0, 1]))
            continue
        if kind == lib.CPS_OBSTACLE_MESH:
            yield Shape(name, _mesh(obstacle.mesh, point, frame, low - 0.5 * span, high + 0.5 * span), None)
            continue
        if kind == lib.CPS_OBSTACLE_PLANE:
            normal = axis
            a, b = (np.linspace(local[:, i].min() - 0.1 * span, local[:, i].max() + 0.1 * span, 9) for i in (0, 1))
            grid = np.stack([*np.meshgrid(a, b), np.zeros((9, 9))], -1)
        elif kind == lib.CPS_OBSTACLE_CYLINDER:
            z = np.linspace(local[:, 2].min() - max(0.1 * span, radius), local[:, 2].max() + max(0.1 * span, radius), 7)
            distance = np.full(7, radius)
            if not shape.inside:  # what is cut off is closed
                distance, z = np.r_[0, distance, 0], np.r_[z[0], z, z[-1]]
            grid = _turn_round(distance, z)
        elif kind == lib.CPS_OBSTACLE_CONE:
            grid = _cone(radius, shape.angle, max(local[:, 2].max() + 0.1 * span, 3 * radius))
        elif kind in (lib.CPS_OBSTACLE_SPHERE, lib.CPS_OBSTACLE_CAPSULE):
            polar, half = np.linspace(0, np.pi, 26), 0.5 * shape.length if kind == lib.CPS_OBSTACLE_CAPSULE else 0.0
            grid = _turn_round(radius * np.sin(polar), -radius * np.cos(polar) + np.repeat([-half, half], 13))
        elif kind == lib.CPS_OBSTACLE_TORUS:
            t = np.linspace(0, 2 * np.pi, 25)
            grid = _turn_round(shape.main_radius + radius * np.cos(t), radius * np.sin(t), 73)
        elif kind == lib.CPS_OBSTACLE_BOX:
            grid = _box(np.array(list(shape.size)) / 2, radius)
        else:
            continue  # a surface is a function of a program in C: scenes have none
        yield Shape(name, _quadrangles(point + grid @ frame), normal)


def _turn_round(distance: np.ndarray, height: np.ndarray, count: int = 49) -> np.ndarray:
    """A surface of revolution about the third axis: (profile, angles, 3)."""
    angle = np.linspace(0, 2 * np.pi, count)
    return np.stack([np.outer(distance, np.cos(angle)), np.outer(distance, np.sin(angle)), np.outer(height, np.ones(count))], -1)


def _cone(radius: float, angle: float, length: float) -> np.ndarray:
    """A ball rounds the tip, up to where the side touches it."""
    polar = np.linspace(0, np.pi / 2 - angle, 9)
    distance, height = radius * np.sin(polar), radius * (1 - np.cos(polar))
    further = np.linspace(height[-1], max(length, 2 * height[-1]), 9)[1:]
    return _turn_round(np.r_[distance, distance[-1] + (further - height[-1]) * np.tan(angle)], np.r_[height, further])


def _box(half: np.ndarray, radius: float) -> np.ndarray:
    """A sphere whose eight parts are moved apart."""
    quarter = np.linspace(0, np.pi / 2, 7)
    azimuth = np.r_[quarter, quarter + np.pi / 2, quarter + np.pi, quarter + 1.5 * np.pi, 0]
    east = np.r_[np.ones(7), -np.ones(14), np.ones(7), 1]
    north = np.r_[np.ones(14), -np.ones(14), 1]
    polar, up = np.r_[np.pi, np.pi, np.pi - quarter[1:], quarter[::-1], 0, 0], np.r_[-np.ones(8), np.ones(9)]
    inner = half - radius
    wide = np.sin(polar)[:, None]
    x = radius * wide * np.cos(azimuth) + inner[0] * east
    y = radius * wide * np.sin(azimuth) + inner[1] * north
    z = np.repeat((radius * np.cos(polar) + inner[2] * up)[:, None], len(azimuth), 1)
    grid = np.stack([x, y, z], -1)
    grid[[0, -1], :, :2] = 0  # bottom and top close in their middle
    return grid


def _quadrangles(grid: np.ndarray) -> np.ndarray:
    return np.stack([grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]], 2).reshape(-1, 4, 3)


def _ground(obstacle: Any, point: np.ndarray, low: np.ndarray, high: np.ndarray, margin: float) -> np.ndarray:
    grid = lib.cps_ground_grid(obstacle.ground)

    def places(values: Any, count: int, axis: int) -> np.ndarray:
        a, b = low[axis] - margin - point[axis], high[axis] + margin - point[axis]
        if not grid.extends:
            a, b = max(a, values[0]), min(b, values[count - 1])
        return np.linspace(a, b, 41)
    x, y = places(grid.x, grid.x_count, 0), places(grid.y, grid.y_count, 1)
    z = [[lib.cps_ground_height(obstacle.ground, a, b, ffi.NULL) for a in x] for b in y]
    return _quadrangles(point + np.stack([*np.meshgrid(x, y), np.array(z)], -1))


def _mesh(mesh: Any, point: np.ndarray, frame: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    found = lib.cps_mesh_triangles(mesh)
    vertex = np.frombuffer(ffi.buffer(found.vertex, 24 * found.vertex_count)).reshape(-1, 3) @ frame + point
    triangle: np.ndarray = np.frombuffer(ffi.buffer(found.triangle, 12 * found.triangle_count), np.int32).reshape(-1, 3)
    polygons = vertex[triangle]
    if len(polygons) > _MANY:
        polygons = polygons[((polygons.max(1) > low) & (polygons.min(1) < high)).all(1)]
    return polygons
