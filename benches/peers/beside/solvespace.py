"""SolveSpace's solver, through python-solvespace, as a program that times itself.

See src/beside.rs for what it is sent and how it answers.
"""

import json
import sys
import time

from python_solvespace import ResultFlag, SolverSystem

scene = json.loads(sys.stdin.readline())
system = SolverSystem()
plane = system.create_2d_base()
held = set(scene["ground"]) | {p for p, _ in scene["driven"]}
points = {}
# What is known belongs to the first group, what is sought to the second.
for p in sorted(held):
    points[p] = system.add_point_2d(*scene["points"][p], plane)
system.set_group(2)
for p, at in enumerate(scene["points"]):
    if p not in held:
        points[p] = system.add_point_2d(*at, plane)


def line(a, b):
    return system.add_line_2d(points[a], points[b], plane)


for kind, *rest in scene["relations"]:
    if kind == "length":
        a, b, length = rest
        system.distance(points[a], points[b], length, plane)
    elif kind == "equal":
        a, b, c, d = rest
        system.equal(line(a, b), line(c, d), plane)
    else:
        p, a, b = rest
        system.coincident(points[p], line(a, b), plane)

driven = [(points[p].params, about) for p, about in scene["driven"]]
offsets = scene["offsets"]
print("ready", flush=True)

for text in sys.stdin:
    word, *rest = text.split()
    if word == "pose":
        places = [system.params(points[p].params) for p in range(len(points))]
        print(json.dumps(places), flush=True)
        continue
    begin, n = map(int, rest)
    n_failed = 0
    begun = time.process_time()
    for k in range(begin + 1, begin + n + 1):
        x, y = offsets[k % len(offsets)]
        for params, about in driven:
            system.set_params(params, (about[0] + x, about[1] + y))
        n_failed += system.solve() != ResultFlag.OKAY
    print(time.process_time() - begun, n_failed, flush=True)
