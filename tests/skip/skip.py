"""What scenes do not need, and what it costs: skip.py WEIR_SKIP OUT.csv

Each case is run where the thing is absent, where it is there but nothing needs it now, and where it
works. Instructions of the measured steps are counted by callgrind, so they repeat exactly. Prints a
table and writes name,value,unit,target,ok. Exit status 1 if something that is skipped costs more
than its target.
"""
import csv
import re
import subprocess
import sys
import tempfile

# Skipped over absent; what is skipped by all must not cost more than a fiftieth.
TARGETS = {"solids": 1.02, "lines": 1.02, "raster": 1.02, "rectangle": 1.02, "columns": 2.0,
           "domain": 1.05, "level": 1.05, "weightless": 1.02, "sleep": 0.02, "regions": 1.1, "looking": 1.01}
# A tank that is empty but for a window must not cost memory either: skipped over absent.
MEMORY = {"domain": 1.1, "level": 1.1}
TIMED = "domain"


def measure(program, name, way):
    """Instructions for each particle and substep, nodes rasterized, bytes of world."""
    with tempfile.NamedTemporaryFile() as out:
        run = subprocess.run(["valgrind", "--tool=callgrind", "--collect-atstart=no",
                              "--toggle-collect=weir_skip_measured",
                              f"--callgrind-out-file={out.name}", program, name, way],
                             text=True, check=True, stdout=subprocess.PIPE,
                             stderr=subprocess.DEVNULL)
        with open(out.name, encoding="utf-8") as counts:
            total = int(re.search(r"^(?:summary|totals): (\d+)", counts.read(), re.M).group(1))
    particle_substeps, nodes, world, _ = run.stdout.split()
    return total / int(particle_substeps), int(nodes), int(world)


def seconds(program, name, way):
    run = subprocess.run([program, name, way], text=True, check=True, stdout=subprocess.PIPE)
    return float(run.stdout.split()[3])


def time_ratio(program, name):
    """Of the skipped case over the absent one: the median of ratios of runs side by side."""
    ratios = sorted(seconds(program, name, "skipped") / seconds(program, name, "absent")
                    for _ in range(9))
    return ratios[4]


def main():
    program = sys.argv[1]
    listing = subprocess.run([program], text=True, check=True, stdout=subprocess.PIPE).stdout
    cases = {}
    for line in listing.splitlines():
        name, way, skipped = line.split(";")
        cases.setdefault(name, (skipped, []))[1].append(way)
    rows = []
    held = True
    print("instructions for each particle and substep; nodes rasterized; bytes of world")
    for name, (skipped, ways) in cases.items():
        cost = {way: measure(program, name, way) for way in ways}
        for way in ways:
            instructions, nodes, world = cost[way]
            what = skipped if way == "skipped" else ""
            print(f"{name:<14} {way:<8} {instructions:>10.1f} {nodes:>8} {world:>12,}  {what}")
            rows.append([f"{name} {way}", round(instructions, 2), "instructions/particle/substep",
                         "", ""])
        for limits, column, said, row in ((TARGETS, 0, "skipped", "skipped/absent"),
                                          (MEMORY, 2, "bytes skipped", "bytes")):
            if name in limits:
                ratio = cost["skipped"][column] / cost["absent"][column]
                ok = ratio <= limits[name]
                held = held and ok
                print(f"{name:<14} {said} over absent {ratio:.4f} (target {limits[name]})"
                      f"{'' if ok else '  SHORT'}")
                rows.append([f"{name} {row}", round(ratio, 4), "ratio", f"<={limits[name]}",
                             "yes" if ok else "short"])
        if "used" in cost:
            ratio = cost["used"][0] / cost["skipped"][0]
            print(f"{name:<14} used over skipped   {ratio:.3f}")
            rows.append([f"{name} used/skipped", round(ratio, 3), "ratio", "", ""])
        if name == TIMED:
            ratio = time_ratio(program, name)
            print(f"{name:<14} skipped over absent {ratio:.3f} in time (not a test)")
            rows.append([f"{name} time", round(ratio, 3), "ratio", "<=1.05",
                         "yes" if ratio <= 1.05 else "short"])
    with open(sys.argv[2], "w", newline="", encoding="utf-8") as out:
        table = csv.writer(out)
        table.writerow(["name", "value", "unit", "target", "ok"])
        table.writerows(rows)
    return 0 if held else 1


if __name__ == "__main__":
    sys.exit(main())
