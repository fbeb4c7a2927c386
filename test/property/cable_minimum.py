# SPDX-License-Identifier: BSD-3-Clause
"""The energy of S90 on a line of few elements, minimised: a second opinion, with no code in common with the library.

J** + j (P4.2), the functional of P5.5, and bounds of the least energy of P4.2 from a minimum of P5.5 without stiffness:

    minimum of P5.5 - delta sum A  <=  minimum of P4.2  <=  minimum of P5.5 + sum R^2/(2 lambda h) [+ sum l T^2/(2 K)]

The left side is P5.5 at the solution of P4.2; the right one is weak duality, with the forces R of the penalty (and T of a stiffness that
stands for an inextensible line) as multipliers. Minimised by damped Newton steps with a band factor.
"""
import math

BAND = 8  # bending joins a node to the next but one


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def norm(a):
    return math.sqrt(dot(a, a))


class Step:
    """One step: what P2.1 is given. Places are tuples, one per node.

    lengths   of the elements [m]             stiffness  K [N]
    load      per node [N]                    reference  x_R per node [m]
    normal    of the plane                    height     psi(x_R) per node [m], None where contact is not asked for
    bound     A per node [N]                  held       {node: place}
    """

    def __init__(self, lengths, stiffness, load, reference, normal, height, bound, held):
        self.lengths, self.stiffness, self.load, self.reference = lengths, stiffness, load, reference
        self.normal, self.height, self.bound, self.held = normal, height, bound, held
        n = len(lengths) + 1
        self.share = [(lengths[j - 1] / 2 if j > 0 else 0) + (lengths[j] / 2 if j + 1 < n else 0) for j in range(n)]

    def slopes(self, x):
        return [tuple((b - a) / l for a, b in zip(p, q)) for p, q, l in zip(x, x[1:], self.lengths)]

    def tensions(self, x):
        return [self.stiffness * max(0.0, norm(u) - 1) for u in self.slopes(x)]

    def slip(self, x, j):
        """Tangential part of x - x_R at node j, and its height over the plane (None without contact)."""
        u = sub(x[j], self.reference[j])
        across = dot(u, self.normal)
        slid = tuple(c - across * n for c, n in zip(u, self.normal))
        return slid, None if self.height[j] is None else across + self.height[j]

    def relaxed(self, x):
        """J** + j at x."""
        energy = 0.0
        for u, l in zip(self.slopes(x), self.lengths):
            energy += l * self.stiffness / 2 * max(0.0, norm(u) - 1) ** 2
        for j, b in enumerate(self.load):
            energy += self.bound[j] * norm(self.slip(x, j)[0]) - dot(b, x[j])
        return energy

    def bending_weight(self, i):
        """g_i: |x''|^2 between the middles of neighbouring elements, and from the end, where u = 0, to the first middle."""
        return 2 / (self.lengths[i] + (self.lengths[i - 1] if i > 0 else 0))

    def functional(self, x, penalty, stiff, delta):
        """P5.5 at x, as a sum of its parts beyond J** + j."""
        energy = self.relaxed(x)
        before = (0.0, 0.0, 0.0)
        for i, u in enumerate(self.slopes(x)):
            turn = sub(u, before)
            energy += stiff * self.bending_weight(i) * dot(turn, turn) / 2
            before = u
        for j in range(len(x)):
            slid, height = self.slip(x, j)
            energy += self.bound[j] * (math.hypot(delta, norm(slid)) - norm(slid))
            if height is not None and height < 0:
                energy += penalty * self.share[j] * height * height / 2
        return energy


def derivatives(step, x, penalty, stiff, delta, second):
    """Gradient (n x 3) and, if asked for, the Hessian's lower band as rows of BAND + 1, diagonal last, over all nodes."""
    n = len(x)
    g = [[-c for c in b] for b in step.load]
    h = [[0.0] * (BAND + 1) for _ in range(3 * n)] if second else None

    def add(i, j, a, b, v):  # a I + b v v^T into the block of nodes i >= j
        for r in range(3):
            row = h[3 * i + r]
            for s in range(r + 1 if i == j else 3):
                row[BAND + 3 * (j - i) + s - r] += (a if r == s else 0) + b * v[r] * v[s]

    slopes = step.slopes(x)
    for i, (u, l) in enumerate(zip(slopes, step.lengths)):
        s = norm(u)
        if s > 1:
            pull = step.stiffness * (s - 1) / s
            for k in range(3):
                g[i][k] -= pull * u[k]
                g[i + 1][k] += pull * u[k]
            if second:
                a, b = pull / l, (step.stiffness - pull) / (s * s) / l
                add(i, i, a, b, u), add(i + 1, i + 1, a, b, u), add(i + 1, i, -a, -b, u)
        if stiff > 0:
            k = stiff * step.bending_weight(i)
            turn = sub(u, slopes[i - 1]) if i > 0 else u
            c = [(i + 1, 1 / l), (i, -1 / l - (1 / step.lengths[i - 1] if i > 0 else 0))] + ([(i - 1, 1 / step.lengths[i - 1])] if i > 0 else [])
            for p, cp in c:
                for r in range(3):
                    g[p][r] += k * cp * turn[r]
                if second:
                    for q, cq in c:
                        if q <= p:
                            add(p, q, k * cp * cq, 0, turn)
    for j in range(n):
        slid, height = step.slip(x, j)
        if step.bound[j] > 0:
            r = math.hypot(delta, norm(slid))
            k = step.bound[j] / r
            for c in range(3):
                g[j][c] += k * slid[c]
            if second:
                add(j, j, k, -k / (r * r), slid), add(j, j, 0, -k, step.normal)
        if height is not None and height < 0:
            for c in range(3):
                g[j][c] += penalty * step.share[j] * height * step.normal[c]
        if second and height is not None and height <= 0:
            add(j, j, 0, penalty * step.share[j], step.normal)
    for j in step.held:
        g[j] = [0.0, 0.0, 0.0]
    return [c for row in g for c in row], h


def newton_direction(step, g, h, damping):
    """-(H + damping I)^-1 g with held nodes fixed; None where H is not definite."""
    n = len(g)
    a = [row[:] for row in h]
    for j in step.held:
        for r in range(3 * j, 3 * j + 3):
            a[r] = [0.0] * BAND + [1.0]
            for s in range(r + 1, min(n, r + BAND + 1)):
                a[s][BAND + r - s] = 0.0
    y = [-c for c in g]
    for r in range(n):
        row = a[r]
        row[BAND] += damping
        first = max(0, r - BAND)
        for c in range(first, r):
            other = a[c]
            low = max(first, c - BAND)
            total = row[BAND + c - r]
            for k in range(low, c):
                total -= row[BAND + k - r] * other[BAND + k - c]
            row[BAND + c - r] = total / other[BAND]
        total = row[BAND]
        for k in range(first, r):
            total -= row[BAND + k - r] ** 2
        if not total > 0:
            return None
        row[BAND] = math.sqrt(total)
        y[r] = (y[r] - sum(row[BAND + k - r] * y[k] for k in range(first, r))) / row[BAND]
    for r in range(n - 1, -1, -1):
        y[r] = (y[r] - sum(a[s][BAND + r - s] * y[s] for s in range(r + 1, min(n, r + BAND + 1)))) / a[r][BAND]
    return y


def minimise_at(step, x, penalty, stiff, delta, most=400):
    """Newton steps from x; the largest force left is returned with the places."""
    damping, stuck = 1e-12, 0
    for _ in range(most):
        g, h = derivatives(step, x, penalty, stiff, delta, True)
        left = max(abs(c) for c in g)
        if left <= 1e-13 or stuck > 6:
            break
        while (d := newton_direction(step, g, h, damping)) is None:
            damping = max(10 * damping, 1e-12)
        slope = sum(a * b for a, b in zip(g, d))
        low, high, t = 0.0, None, 1.0
        for _ in range(60):  # the slope only rises along the line: halve towards where it is small
            y = [tuple(c + t * d[3 * j + k] for k, c in enumerate(p)) for j, p in enumerate(x)]
            now = sum(a * b for a, b in zip(derivatives(step, y, penalty, stiff, delta, False)[0], d))
            if abs(now) <= 0.3 * abs(slope) or (now < 0 and high is None):
                break
            low, high = (t, high) if now < 0 else (low, t)
            t = (low + high) / 2
        damping = min(1e-2, damping * 10) if t < 0.2 else max(1e-12, damping / 10)
        move = max(abs(t * c) for c in d)
        stuck = stuck + 1 if move <= 1e-15 else 0
        x = y
    return x, left


def minimise(step, penalty, stiff, delta):
    """P5.5 at these parameters, by way of easier ones, in units of length and force of order 1."""
    coarse = (10.0, 1e-3, 0.03)
    far = max(penalty / coarse[0], coarse[2] / delta, coarse[1] / stiff if stiff > 0 else 1)
    stages = max(1, math.ceil(math.log(far) / math.log(20)))
    x = [step.held.get(j, p) for j, p in enumerate(step.reference)]
    for k in range(1, stages + 1):
        t = k / stages
        x, left = minimise_at(step, x, coarse[0] * (penalty / coarse[0]) ** t,
                              coarse[1] * (stiff / coarse[1]) ** t if stiff > 0 else 0.0, coarse[2] * (delta / coarse[2]) ** t)
    return x, left


def least_energy(step, inextensible=False, penalty=1e9, delta=1e-10):
    """The places of a minimum of P4.2 nearly, and bounds of its energy; the reactions per node."""
    x, left = minimise(step, penalty, 0.0, delta)
    value = step.functional(x, penalty, 0.0, delta)
    push = []
    for j in range(len(x)):
        height = step.slip(x, j)[1]
        push.append(penalty * step.share[j] * max(0.0, -height) if height is not None else 0.0)
    above = sum(r * r / (2 * penalty * h) for r, h in zip(push, step.share))
    if inextensible:
        above += sum(l * t * t / (2 * step.stiffness) for l, t in zip(step.lengths, step.tensions(x)))
    slack = 4 * left * len(x)  # a convex function is nearer to its minimum than gradient times distance
    return x, push, (value - delta * sum(step.bound) - slack, value + above + slack)
