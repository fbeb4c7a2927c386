/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles as the checker sees them: planes, cylinders, balls, ground and meshes in long double,
 * written from docs/theory.md. */
#ifndef CAPSTAN_CHECKER_SURFACE_H
#define CAPSTAN_CHECKER_SURFACE_H

#include <stdbool.h>

#include "conic.h"
#include "ground.h"
#include "mesh.h"

/* flag values of the file */
enum {
    SURFACE_PLANE,
    SURFACE_CYLINDER,
    SURFACE_SPHERE,
    SURFACE_GROUND,
    SURFACE_FUNCTION, /* of which the file says nothing */
    SURFACE_CAPSULE,
    SURFACE_TORUS,
    SURFACE_CONE,
    SURFACE_BOX,
    SURFACE_MESH,
    SURFACE_KINDS
};

typedef struct Surface {
    int kind;
    bool box, grained;
    Real point[3], axis[3], radius;                    /* axis of length 1 */
    bool inside;                                       /* lines are inside of it */
    Real length, main_radius, angle, size[3], side[3]; /* of capsule, torus, cone, box (shape.h) */
    Real gives;                                        /* [N/m3] pressure over depth; 0: rigid */
    Real damps;                                        /* [N s/m3] of what gives */
    Real mu[2], grain[3];                              /* along the line or the grain, and across */
    /* shift of the last step: it turned by the vector `spin` about a point, which went by `by` */
    Real by[3], spin[3], about[3];
    Ground *ground; /* of ground, else NULL */
    Mesh *mesh;     /* of a mesh, else NULL */
    bool faces;     /* of several feet of a place on the mesh the one whose normal is nearest to */
    Real facing[3]; /* ... this is meant, not the nearest */
    Conic *set;     /* forces per unit normal force in place of the coefficients, or NULL */
} Surface;

/* Free its set and ground. */
void surface_free(Surface *surface);
/* Is it a cylinder or a ball, with the lines outside? */
bool surface_is_round(const Surface *surface);
/* Has a file contacts of elements with it, be they the third ones of nodes? */
bool surface_has_elements(const Surface *surface);
/* Do elements touch it at their nodes alone, so that the contact of one may be a node's third? */
bool surface_may_be_third(const Surface *surface);
/* May an element whose ends are outside cut into it? */
bool surface_is_cut(const Surface *surface);
/* The surface that is deeper by `depth`. */
Surface surface_within(const Surface *surface, Real depth);
/* The surface as a contact with this normal sees it: of several feet of a place on a rigid mesh,
 * that with the normal nearest to it. */
Surface surface_seen(const Surface *surface, const double *normal);
/* The heights of x above its feet and the normals there: one, but for meshes. Returns their
 * number. */
size_t surface_feet(const Surface *surface, const Real *x, Real gap[MESH_FEET],
                    Real normal[MESH_FEET][3]);
/* By which its friction is multiplied at x. */
Real surface_factor(const Surface *surface, const Real *x);
/* Does what is known of it end before x, but for `rounding`? */
bool surface_ends(const Surface *surface, const Real *x, Real rounding);
/* [m] above the surface, negative below it; of ground to first order. Of a mesh above the faces
 * that lie its radius above the triangles. */
Real surface_distance(const Surface *surface, const Real *x);
/* How deep an element of natural length l may lie in a round obstacle: its chord cuts in,
 * min(l^2/(4 R), R/4). */
Real surface_allowance(const Surface *surface, Real l);
/* Where between its ends a (0) and b (1) an element is nearest to the axis or centre, if
 * anywhere. */
Real surface_facing(const Surface *surface, const Real *a, const Real *b);
/* [m] How much deeper than its natural length l allows the straight element from a to b lies in a
 * round obstacle between its ends; negative where it does not, -INFINITY where an end is nearest to
 * the middle. */
Real surface_pierced(const Surface *surface, const Real *a, const Real *b, Real l);
/* Unit normal at the foot of x. */
void surface_normal(const Surface *surface, const Real *x, Real *n);
/* Is it shifted in the step? */
bool surface_moves(const Surface *surface);
/* v turned by the angle |spin| about `spin`. */
void surface_spin(const Real *v, const Real *spin, Real *out);
/* x carried along by the last part, a share, of the shift, and back. */
void surface_shift(const Surface *surface, const Real *x, Real share, Real *out);
void surface_unshift(const Surface *surface, const Real *x, Real share, Real *out);
/* x carried along by that, and by a share of a turn about the surface's own axis. */
void surface_carry(const Surface *surface, const Real *x, Real share, Real turn, Real *out);
/* ... and back: where that took x from. */
void surface_uncarry(const Surface *surface, const Real *x, Real share, Real turn, Real *out);
/* The path of the surface under x, where a node has come to from `reference`, plus its slip. */
void surface_own(const Surface *surface, const Real *x, const Real *reference, Real share,
                 Real *out);
/* The shorter geodesic between the feet of two points, as the tangent vector of its length with
 * which it arrives; on ground an arc between them that turns by the angle between the normals,
 * on a mesh their chord. */
void surface_slip(const Surface *surface, const Real *from, const Real *to, Real *out);
/* [rad] Between the normals of a round surface at two points, 0 to pi. 0 of a plane. */
Real surface_angle(const Surface *surface, const Real *a, const Real *b);
/* The tangent plane's axes where the normal is n: the grain, or the direction `along`, and across.
 * False where that direction has no tangent part. */
bool surface_axes(const Surface *surface, const Real *n, const Real *along, Real axes[2][3]);
/* The larger coefficient; 1 where a set is given. */
Real surface_friction(const Surface *surface);
/* Does what a node sees of it change with the node's place or the line's direction? */
bool surface_follows(const Surface *surface);

/* Friction forces F1, F2 with the bound w of the larger coefficient, or w times the set: how far
 * outside the set [N], and phi(s) + F.s of a slip s [J], whose dissipation is *phi. */
Real surface_excess(const Surface *surface, Real w, const Real F[2]);
Real surface_gap(const Surface *surface, Real w, const Real F[2], const Real s[2], Real *phi);

/* By how much a disc that contains the forces of a box is larger than its longer half-axis. */
Real surface_disc_factor(const Surface *on);
/* The part of v in the surface's tangent plane; returns its part along the normal. */
Real surface_split(const Surface *on, const Real *v, Real *across);

#endif
