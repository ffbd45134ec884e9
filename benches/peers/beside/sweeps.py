"""A grid of four-bars, each over one turn of its crank: `sweeps.py NAME SIDE CORES` prints seconds from
start to end, seconds of the processor, and the worst error of the extremes of the transmission angle,
degrees. What is compiled was compiled before.

The crank is 1, the frame 4; the coupler takes SIDE values from 3 to 5 and the rocker as many from 3 to
4. Of 360 frames the least and the greatest angle between coupler and rocker are kept.
"""

import multiprocessing
import os
import sys
import time

import numpy as np

FRAMES = 360
CRANK, FRAME = 1.0, 4.0
# Variants whose paths are kept at once.
BLOCK = 1000


def lengths(side):
    """Couplers and rockers, a pair for each variant, in the order of the table."""
    b = 3.0 + 2.0 / side * np.arange(side)
    c = 3.0 + 1.0 / side * np.arange(side)
    return np.repeat(b, side), np.tile(c, side)


def extremes(b, c):
    """The angle between coupler and rocker in the two poses with the crank along the frame."""
    return [
        np.degrees(np.arccos((b * b + c * c - d * d) / (2 * b * c)))
        for d in (FRAME - CRANK, FRAME + CRANK)
    ]


def by_hand(side, cores):
    """Two circles meet, written out and compiled by numba: the limit of what Python can do."""
    import numba

    @numba.njit(parallel=True)
    def sweep(b, c, least, greatest):
        for k in numba.prange(b.size):
            lo, hi = np.inf, -np.inf
            for frame in range(FRAMES + 1):
                phi = 2 * np.pi * frame / FRAMES
                x, y = CRANK * np.cos(phi), CRANK * np.sin(phi)
                ex, ey = FRAME - x, -y
                q = ex * ex + ey * ey
                along = 0.5 + (b[k] * b[k] - c[k] * c[k]) / (2 * q)
                across = np.sqrt(b[k] * b[k] / q - along * along)
                cx, cy = x + along * ex - across * ey, y + along * ey + across * ex
                ux, uy, vx, vy = cx - x, cy - y, cx - FRAME, cy
                mu = np.arctan2(ux * vy - uy * vx, ux * vx + uy * vy)
                lo, hi = min(lo, mu), max(hi, mu)
            least[k], greatest[k] = np.degrees(lo), np.degrees(hi)

    numba.set_num_threads(cores)
    b, c = lengths(side)
    least, greatest = np.empty_like(b), np.empty_like(b)
    sweep(b[:2], c[:2], least[:2], greatest[:2])
    begun = clocks()
    sweep(b, c, least, greatest)
    return taken(begun), least, greatest


def linkage():
    """The four-bar as pylinkage has it, and what its solver starts from."""
    from pylinkage.actuators import Crank
    from pylinkage.bridge.solver_conversion import linkage_to_solver_data
    from pylinkage.components import Ground
    from pylinkage.dyads import RRRDyad
    from pylinkage.simulation import Linkage

    a, d = Ground(0.0, 0.0, name="A"), Ground(FRAME, 0.0, name="D")
    crank = Crank(a, radius=CRANK, angular_velocity=2 * np.pi / FRAMES, name="B")
    c = RRRDyad(crank.output, d, 3.5, 3.0, x=3.0, y=2.9, name="C")
    return linkage_to_solver_data(Linkage([a, d, crank, c]))


def some_members(lengths_of_block):
    """The extremes of some variants, by pylinkage's `simulate_batch` and NumPy."""
    from pylinkage.population._batch_sim import simulate_batch

    begun = time.process_time()
    b, c = lengths_of_block
    template = linkage()
    n = b.size
    dims = np.column_stack([np.full(n, CRANK), b, c])
    starts = np.repeat(template.positions[None], n, axis=0)
    d = FRAME - CRANK
    along = (b * b - c * c + d * d) / (2 * d)
    starts[:, 3, 0], starts[:, 3, 1] = CRANK + along, np.sqrt(b * b - along * along)
    starts[:, 2] = CRANK, 0.0
    paths = simulate_batch(template, dims, starts, FRAMES)
    u, v = paths[:, :, 3] - paths[:, :, 2], paths[:, :, 3] - paths[:, :, 1]
    across = u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
    mu = np.degrees(np.arctan2(across, (u * v).sum(axis=-1)))
    return mu.min(axis=1), mu.max(axis=1), time.process_time() - begun


def by_pylinkage(side, cores):
    """pylinkage's batches, on so many processes."""
    b, c = lengths(side)
    blocks = [(b[k : k + BLOCK], c[k : k + BLOCK]) for k in range(0, b.size, BLOCK)]
    with multiprocessing.get_context("fork").Pool(cores) as pool:
        pool.map(some_members, [(b[:2], c[:2])] * (4 * cores), chunksize=1)
        begun = clocks()
        least, greatest, used = zip(*pool.map(some_members, blocks, chunksize=1))
        seconds, _ = taken(begun)
    return (seconds, sum(used)), np.concatenate(least), np.concatenate(greatest)


def clocks():
    used = os.times()
    return time.perf_counter(), used.user + used.system


def taken(begun):
    return tuple(now - then for now, then in zip(clocks(), begun))


RUNS = {"numba": by_hand, "pylinkage": by_pylinkage}

if __name__ == "__main__":
    name, side, cores = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    (seconds, used), *found = RUNS[name](side, cores)
    errors = [np.max(np.abs(a - b)) for a, b in zip(found, extremes(*lengths(side)))]
    print(seconds, used, max(errors))
