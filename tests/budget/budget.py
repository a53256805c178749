"""What the default scene costs on an emulated Cortex-M4F: budget.py BUILD_FOLDER OUT.csv [RUNS]

Runs the firmware image RUNS times (default 10). Prints instructions per stage, memory by owner,
stack and code, and writes them as name,value,unit,target,ok. Exit status 1 if two runs differ in
any figure: under -icount an instruction count is a property of the program, not of the machine.
"""
import csv
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BOARD = "netduinoplus2"


def run_once(image):
    run = subprocess.run([ROOT / "port/run", BOARD, image], text=True, check=True,
                         stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    return [line for line in run.stdout.splitlines() if not line.startswith("progress")]


def rows_of(lines):
    """Yields (name, value, unit) for every figure that the program printed."""
    facts = [line.split() for line in lines]
    single = {words[0]: words[1:] for words in facts}
    particles = int(single["particles"][0])
    substeps = int(single["substeps"][0]) / int(single["steps"][0])
    for words in facts:
        if words[0] == "ticks":
            yield f"{words[1]} mean", int(words[2]), "instructions/step"
            yield f"{words[1]} worst", int(words[3]), "instructions/step"
        elif words[0] == "memory":
            yield f"memory {words[1]}", int(words[2]), "bytes"
    step = next(int(words[2]) for words in facts if words[:2] == ["ticks", "step"])
    yield "whole step", round(step / substeps / particles, 1), "instructions/particle/substep"
    yield "stack high-water", int(single["stack"][0]), "bytes"
    yield "code", int(single["code"][0]), "bytes"


def main():
    image = pathlib.Path(sys.argv[1]) / "examples/run_scene" / f"run_scene.{BOARD}.elf"
    runs = int(sys.argv[3]) if len(sys.argv) > 3 else 10
    outputs = [run_once(image) for _ in range(runs)]
    equal = sum(output == outputs[0] for output in outputs)
    rows = list(rows_of(outputs[0]))
    for name, value, unit in rows:
        print(f"{name:<28} {value:>14,} {unit}")
    print(f"{equal} of {runs} runs equal in every figure")
    with open(sys.argv[2], "w", newline="", encoding="utf-8") as out:
        table = csv.writer(out)
        table.writerow(["name", "value", "unit", "target", "ok"])
        for name, value, unit in rows:
            table.writerow([name, value, unit, "", ""])
        table.writerow(["equal runs", equal, "runs", f"=={runs}", "yes" if equal == runs else "short"])
    return 0 if equal == runs else 1


if __name__ == "__main__":
    sys.exit(main())
