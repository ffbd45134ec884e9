"""Products that compile a linkage, or solve many frames at once, on W1 and W2, each timing itself:
`compiled.py NAME WORK FRAMES` prints nanoseconds of the processor a frame, the worst error of a bar
relative to the size, and where the last point ended.
"""

import math
import sys
import time

import numpy as np

STEP = math.radians(1)
# A crank's radius and centre, points that stand still, and then each point by two others, the
# distances to these, the side, and where it is looked for first.
WORKS = {
    "W1": {
        "crank": 1.0,
        "still": {"D": (4.0, 0.0)},
        "dyads": {"C": ("X", "D", 3.5, 3.0, 1, (3, 2.9))},
        "size": 4.0,
    },
    "W2": {
        "crank": 15.0,
        "still": {"B": (-38.0, -7.8)},
        "dyads": {
            "J": ("X", "B", 50.0, 41.5, -1, (-19, 29)),
            "K": ("X", "B", 61.9, 39.3, 1, (-27, -45.5)),
            "H": ("J", "B", 55.8, 40.1, -1, (-74, 9.5)),
            "N": ("H", "K", 39.4, 36.7, -1, (-62, -28)),
            "F": ("N", "K", 65.7, 49.0, -1, (-43, -92)),
        },
        "size": 100.0,
    },
}


def worst(work, places):
    """The worst error of a bar over frames, relative to the size; `places` are arrays by name."""
    errors = [0.0]
    for p, (a, b, l, m, *_) in work["dyads"].items():
        for q, length in ((a, l), (b, m)):
            d = np.asarray(places[p]) - np.asarray(places[q])
            errors.append(np.max(np.abs(np.hypot(d[..., 0], d[..., 1]) - length)))
    return max(errors) / work["size"]


def pylinkage_of(work):
    from pylinkage.actuators import Crank
    from pylinkage.components import Ground
    from pylinkage.dyads import RRRDyad
    from pylinkage.simulation import Linkage

    crank = Crank(Ground(0.0, 0.0), radius=work["crank"], angular_velocity=STEP)
    parts = {name: Ground(*at, name=name) for name, at in work["still"].items()}
    parts["X"] = crank
    for p, (a, b, l, m, _, (x, y)) in work["dyads"].items():
        of = [parts[q].output if q == "X" else parts[q] for q in (a, b)]
        parts[p] = RRRDyad(*of, l, m, x=x, y=y, name=p)
    return list(parts), Linkage([crank.anchor, *parts.values()])


def pylinkage_fast(work, n):
    names, linkage = pylinkage_of(work)
    linkage.step_fast(360)
    begun = time.process_time()
    path = linkage.step_fast(n)
    used = time.process_time() - begun
    return used, {name: path[:, k + 1] for k, name in enumerate(names)}


def pylinkage_step(work, n):
    for _ in pylinkage_of(work)[1].step(2):
        pass  # What it compiles is compiled now.
    names, linkage = pylinkage_of(work)
    begun = time.process_time()
    path = list(linkage.step(n))
    used = time.process_time() - begun
    path = np.array(path, dtype=float)
    return used, {name: path[:, k + 1] for k, name in enumerate(names)}


def numpy_array(work, n):
    def all_frames():
        phi = STEP * np.arange(1, n + 1)
        places = {name: np.broadcast_to(at, (n, 2)) for name, at in work["still"].items()}
        places["X"] = work["crank"] * np.stack([np.cos(phi), np.sin(phi)], axis=1)
        for p, (a, b, l, m, side, _) in work["dyads"].items():
            e = places[b] - places[a]
            q = e[:, 0] ** 2 + e[:, 1] ** 2
            along = 0.5 + (l * l - m * m) / (2 * q)
            across = side * np.sqrt(((l + m) ** 2 - q) * (q - (l - m) ** 2)) / (2 * q)
            turned = np.stack([-e[:, 1], e[:, 0]], axis=1)
            places[p] = places[a] + e * along[:, None] + turned * across[:, None]
        return places

    all_frames()
    begun = time.process_time()
    places = all_frames()
    return time.process_time() - begun, places


def equations(work, at, cross):
    """The values of all bars, for places given by name."""
    rows = []
    for p, (a, b, l, m, *_) in work["dyads"].items():
        rows += [cross(at[p], at[a]) - l * l, cross(at[p], at[b]) - m * m]
    return rows


def casadi_newton(work, n):
    import casadi

    names = list(work["dyads"])
    unknown, crank = casadi.SX.sym("u", 2 * len(names)), casadi.SX.sym("x", 2)
    at = {name: casadi.DM(place) for name, place in work["still"].items()}
    at["X"] = crank
    at.update({p: unknown[2 * k : 2 * k + 2] for k, p in enumerate(names)})
    rows = equations(work, at, lambda p, q: casadi.sumsqr(p - q))
    system = casadi.Function("f", [unknown, crank], [casadi.vertcat(*rows)])
    solve = casadi.rootfinder("s", "newton", system, {"abstol": 1e-11 * work["size"]})
    phi = STEP * np.arange(1, n + 1)
    driven = work["crank"] * np.stack([np.cos(phi), np.sin(phi)])
    start = np.array([work["dyads"][p][5] for p in names], dtype=float).ravel()
    run = solve.mapaccum(n)
    begun = time.process_time()
    found = np.array(run(start, driven))
    used = time.process_time() - begun
    places = {p: found[2 * k : 2 * k + 2].T for k, p in enumerate(names)}
    places.update(work["still"], X=driven.T)
    return used, places


def scipy_root(work, n):
    from scipy.optimize import root

    names = list(work["dyads"])
    index = {p: 2 * k for k, p in enumerate(names)}
    fixed = dict(work["still"])

    def values(u, crank):
        at = {**fixed, "X": crank, **{p: u[k : k + 2] for p, k in index.items()}}
        return equations(work, at, lambda p, q: (p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2)

    def rows(u, crank):
        at = {**fixed, "X": crank, **{p: u[k : k + 2] for p, k in index.items()}}
        jacobian = np.zeros((2 * len(names), 2 * len(names)))
        for row, (p, (a, b, *_)) in enumerate(work["dyads"].items()):
            for r, q in ((2 * row, a), (2 * row + 1, b)):
                for c in range(2):
                    g = 2 * (at[p][c] - at[q][c])
                    jacobian[r, index[p] + c] += g
                    if q in index:
                        jacobian[r, index[q] + c] -= g
        return jacobian

    u = np.array([work["dyads"][p][5] for p in names], dtype=float).ravel()
    path = np.empty((n, u.size))
    driven = np.empty((n, 2))
    begun = time.process_time()
    for k in range(n):
        phi = STEP * (k + 1)
        driven[k] = work["crank"] * math.cos(phi), work["crank"] * math.sin(phi)
        u = root(values, u, args=(driven[k],), jac=rows, tol=1e-13).x
        path[k] = u
    used = time.process_time() - begun
    places = {p: path[:, k : k + 2] for p, k in index.items()}
    places.update(work["still"], X=driven)
    return used, places


RUNS = {
    "pylinkage-step_fast": pylinkage_fast,
    "pylinkage-step": pylinkage_step,
    "numpy-array": numpy_array,
    "casadi-newton": casadi_newton,
    "scipy-root": scipy_root,
}

if __name__ == "__main__":
    name, work, n = sys.argv[1], WORKS[sys.argv[2]], int(sys.argv[3])
    used, places = RUNS[name](work, n)
    x, y = np.asarray(places[list(work["dyads"])[-1]])[-1]
    print(1e9 * used / n, worst(work, places), x, y)
