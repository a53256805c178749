"""Time of a whole step as ratios within one run: bench.py WEIR_BENCH ACCEPTED.csv OUT.csv

Runs the program's cases in turn, several times, and takes medians of ratios within a turn. Prints
tables, with the last accepted ratios beside them, and writes name,value,unit,target,ok. Times are
printed and never fail.
"""
import csv
import json
import statistics
import subprocess
import sys

TURNS = 5
COUNTS = (1000, 10000, 75000, 100000, 1000000)
STAGES = ("contour", "particle_to_grid", "grid_update", "pressure", "volume", "grid_to_particle",
          "collide")
PAPER_FPS = {75000: 33.4}


def measure(program):
    """name → its counters, one dictionary for each turn."""
    cases = {}
    for turn in range(TURNS):
        run = subprocess.run([program, "--benchmark_format=json"], text=True, check=True,
                             stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        for case in json.loads(run.stdout)["benchmarks"]:
            name = "/".join(case["name"].split("/")[:3])
            cases.setdefault(name, []).append(case)
        print(f"turn {turn + 1} of {TURNS}", file=sys.stderr)
    return cases


def main():
    program, accepted_path, out_path = sys.argv[1:]
    with open(accepted_path, encoding="utf-8") as file:
        accepted = {row["name"]: float(row["value"]) for row in csv.DictReader(file)}
    cases = measure(program)

    def median(name, counter="ns"):
        return statistics.median(case[counter] for case in cases[name])

    def ratio(a, b, counter="ns"):
        return statistics.median(x[counter] / y[counter] for x, y in zip(cases[a], cases[b]))

    rows = []

    def row(name, value, target):
        met = "" if not target else (
            value <= float(target[2:]) if target[0] == "<" else value >= float(target[2:]))
        ok = {"": "", True: "yes", False: "short"}[met]
        rows.append((name, f"{value:.4g}", "1", target, ok))
        last = f"{accepted[name]:.3g}" if name in accepted else "-"
        print(f"{name:44s} {value:8.3g}  accepted {last:>6s}  {target:7s} {ok}")

    print("ns for each particle and substep, one thread")
    print(f"{'':16s}{'whole':>8s}" + "".join(f"{s[:10]:>11s}" for s in STAGES))
    for scene in ("dam", "solids"):
        for count in COUNTS:
            name = f"{scene}/{count}/1"
            print(f"{name:16s}{median(name):8.1f}" +
                  "".join(f"{median(name, 'ns_' + s):11.2f}" for s in STAGES))
    print("\nframes: substeps a second, as the paper counts them, and steps of 1/60 s")
    for count in COUNTS:
        paper = f"{PAPER_FPS[count]:.1f}" if count in PAPER_FPS else "-"
        one, two = f"dam/{count}/1", f"dam/{count}/2"
        print(f"{count:8d} particles: one thread {median(one, 'substeps_per_s'):9.1f} "
              f"{median(one, 'frames_per_s'):8.1f}, two {median(two, 'substeps_per_s'):9.1f} "
              f"{median(two, 'frames_per_s'):8.1f}; the paper's {paper}")
    print()
    for count in COUNTS:
        row(f"step_over_stream.{count}", ratio(f"dam/{count}/1", f"stream/{count}/1"), "<=2")
    for scene in ("dam", "solids"):
        for count in COUNTS[1:]:
            row(f"threads_2_over_1.{scene}.{count}",
                ratio(f"{scene}/{count}/1", f"{scene}/{count}/2", "wall_ns"),
                ">=1.8" if count > 50000 else "")
        each = [median(f"{scene}/{count}/1") for count in COUNTS]
        row(f"dearest_over_cheapest_count.{scene}", max(each) / min(each), "<=1.3")
        row(f"million_over_thousand.{scene}", ratio(f"{scene}/1000000/1", f"{scene}/1000/1"),
            "<=1.3")
    row("solids_over_none.100000", ratio("solids/100000/1", "dam/100000/1"), "")
    row("paper_over_weir_per_step.100000", ratio("paper/100000/1", "weir/100000/1"), ">=6")
    with open(out_path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(("name", "value", "unit", "target", "ok"))
        writer.writerows(rows)


if __name__ == "__main__":
    main()
