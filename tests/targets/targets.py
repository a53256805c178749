"""What a step costs on each kind of processor, in instructions and bytes.

  targets.py check PROCESSOR BUILD_FOLDER     fails on 2 % more than accepted.txt has
  targets.py accept PROCESSOR=BUILD_FOLDER... writes accepted.txt
  targets.py left_out IMAGE OBJECT...         fails if an object of the library is in an image
  targets.py table OUT.csv PROCESSOR=BUILD_FOLDER...   the table of the README, and a csv

Instructions are counted on the emulated board and repeat to the last one; bytes are read off the
images' maps: what the library puts into them, without port, console and scene.
"""
import csv
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
ACCEPTED = HERE / "accepted.txt"
ALLOWED = 1.02
# An operator of the scalars stands in one object for all who call it: that is not its stage.
SHARED = 64

BOARD = {"cortex-m0": "microbit", "cortex-m3": "mps2-an385", "cortex-m4f": "netduinoplus2",
         "riscv32": "virt", "lx106": "sim"}
SCENES = {"0": "liquid", "1": "solid"}
# Boards with the memory for the scenes of the paper's tables, with and without their solids.
ROOMY = {"cortex-m3": "mps2-an385", "cortex-m4f": "mps2-an386", "riscv32": "virt",
         "lx106": "sim"}
TRANSFERS = ("stage_particle_to_grid", "stage_grid_to_particle")

# Cycles for an instruction, on average over the liquid scene: the instructions that were executed,
# weighed with the processor's manual (loads and stores 2, taken branches and calls 3 on M0 and M3,
# 2 to 3 on M4; divisions 2 to 12; flash without wait states). Of an M0 cycles_m0.cpp counts them.
# Makers of RISC-V and Xtensa chips do not say what their instructions take: there an instruction a cycle is
# the least, and steps a second the most that there can be.
CYCLES = {"cortex-m0": 1.36, "cortex-m3": 1.59, "cortex-m4f": 1.44}

# The example that fills 16 KB: 400 particles on 18 × 18 cells, with a solid.
EXAMPLE = {"cortex-m0": "microbit", "riscv32": "sifive_e"}
EXAMPLE_MHZ = 16
EXAMPLE_TARGET = 30

# Real chips: processor, scalar, MHz, RAM of the class in KB.
CHIPS = [
    ("Cortex-M0, 16 KB (nRF51, 16 MHz)", "cortex-m0", "smallfixed", 16, 16),
    ("Cortex-M0+, 32 KB (48 MHz)", "cortex-m0", "smallfixed", 48, 32),
    ("RISC-V, 20 KB (CH32V203, 144 MHz)", "riscv32", "smallfixed", 144, 20),
    ("Xtensa, 80 KB (ESP8266, 80 MHz)", "lx106", "smallfixed", 80, 80),
    ("Cortex-M3, 8 KB (STM32F100, 24 MHz)", "cortex-m3", "smallfixed", 24, 8),
    ("Cortex-M3, 64 KB (LM3S6965, 50 MHz)", "cortex-m3", "smallfixed", 50, 64),
    ("Cortex-M4F, 64 KB (STM32L431, 80 MHz)", "cortex-m4f", "smallfixed", 80, 64),
    ("Cortex-M4F, 128 KB (STM32F405, 168 MHz), float", "cortex-m4f", "float", 168, 128),
]
# Bytes a particle, bytes a cell and for the whole: world, stack, statics.
BYTES = {"smallfixed": (8, 18), "float": (16, 40)}
REST = 3400

KNOWN = [
    ("STM32L431, 80 MHz, 64 KB", "323", "17 × 17", "50"),
    ("ESP32-S3, 2 cores, 240 MHz", "2,497", "43 × 53", "50"),
    ("CH32V203, no FPU", "128", "16 × 16", "130 to 180"),
    ("RP2350", "500", "23 × 23", "not told"),
    ("Cortex-M0, 4 KB", "60", "not told", "30"),
]


def library_bytes(map_file):
    """Bytes that objects of libweir.a have in an image, from the linker's map, by source file."""
    text = map_file.read_text(encoding="utf-8", errors="replace")
    text = text[text.index("Linker script and memory map"):]
    found = {}
    rows = re.finditer(r"^ \.(?:text|rodata|data)\S*\s+0x[0-9a-f]+\s+0x([0-9a-f]+) (\S+)$", text,
                       re.MULTILINE)
    for row in rows:
        if "libweir.a(" in row.group(2):
            name = row.group(2).split("(")[1].split(".")[0]
            found[name] = found.get(name, 0) + int(row.group(1), 16)
    return found


def left_out(image, objects):
    found = library_bytes(pathlib.Path(f"{image}.map"))
    linked = [f"{name} {found[name]} bytes" for name in objects
              if found.get(name, 0) > SHARED]
    print(f"{len(found)} objects linked", *linked, sep="\nNOT LEFT OUT ")
    return 1 if linked or not found else 0


def facts(board, image):
    """What an image prints on a board, by name."""
    run = subprocess.run([ROOT / "port/run", board, image], text=True, check=True,
                         stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    return {words[0]: int(words[1]) for words in map(str.split, run.stdout.splitlines())}


def measure_solids(processor, folder):
    """Yields (name, value) of the paper's scenes."""
    board = ROOMY.get(processor)
    for image in sorted(folder.glob(f"solid_scenes_*.{board}.elf")):
        real = image.name.split(".")[0].split("_")[2]
        fact = facts(board, image)
        for scene in ("box", "standard", "complex"):
            for way in ("with", "without"):
                cost = (fact[f"{scene}_{way}_instructions"] /
                        fact[f"{scene}_{way}_particle_substeps"])
                yield f"{processor} {real} {scene} {way} solids", round(cost, 1)


def example_ticks(run):
    """Steps, substeps × particles and ticks, as the example prints them."""
    out = subprocess.run(run, text=True, check=True, stdout=subprocess.PIPE,
                         stderr=subprocess.DEVNULL).stdout
    particles = int(re.search(r"^scene \S+ \d+ (\d+) ", out, re.MULTILINE).group(1))
    found = re.search(r"^steps (\d+), substeps (\d+), ticks (\d+) ", out, re.MULTILINE)
    steps, substeps, ticks = map(int, found.groups())
    return steps, substeps * particles, ticks


def example_image(processor, build):
    return pathlib.Path(build) / f"examples/small/pocket.{EXAMPLE.get(processor)}.elf"


def measure_example(processor, build):
    """Yields (name, value) of the example that fills a board: its instructions and, of a microbit,
    its steps a second by the cycles that are counted for each of them."""
    image = example_image(processor, build)
    if not image.exists():
        return
    board = EXAMPLE[processor]
    _, moved, ticks = example_ticks([ROOT / "port/run", board, image])
    yield f"{processor} {board} example instructions", round(ticks / moved, 1)
    if processor != "cortex-m0":
        return
    with tempfile.TemporaryDirectory() as folder:
        tool = pathlib.Path(folder) / "cycles_m0"
        subprocess.run(["c++", "-std=c++17", "-O2", HERE / "cycles_m0.cpp", "-o", tool], check=True)
        steps, _, cycles = example_ticks([tool, image])
    yield "cortex-m0 microbit example cycles a step", round(cycles / steps)


def measure(processor, build):
    """Yields (name, value) of every image of a build."""
    yield from measure_example(processor, build)
    board = BOARD[processor]
    folder = pathlib.Path(build) / "tests/targets"
    yield from measure_solids(processor, folder)
    for image in sorted(folder.glob(f"target_*.{board}.elf")):
        _, real, scene = image.name.split(".")[0].split("_")
        fact = facts(board, image)
        name = f"{processor} {real} {SCENES[scene]}"
        steps = fact["substeps"] * fact["particles"]
        yield f"{name} instructions", round(fact["instructions"] / steps, 1)
        yield f"{name} transfers", round(sum(fact[stage] for stage in TRANSFERS) / steps, 1)
        yield f"{name} code", sum(library_bytes(pathlib.Path(f"{image}.map")).values())
        yield f"{name} stack", fact["stack"]


def accepted():
    rows = (line.rsplit(" ", 1) for line in ACCEPTED.read_text(encoding="utf-8").splitlines())
    return {name: float(value) for name, value in rows}


def check(processor, build):
    known = accepted()
    found = dict(measure(processor, build))
    worse = 0
    for name, value in found.items():
        limit = ALLOWED * known.get(name, 0)
        bad = value > limit
        worse += bad
        print(f"{'MORE' if bad else 'ok':<5} {name:<44} {value:>9} accepted {known.get(name, 0)}")
    missing = [name for name in known if name.startswith(f"{processor} ") and name not in found and
               (" example " not in name or example_image(processor, build).exists())]
    for name in missing:
        print(f"GONE  {name}")
    return 1 if worse or missing or not found else 0


def accept(builds):
    rows = dict(accepted()) if ACCEPTED.exists() else {}
    for processor, build in builds:
        found = dict(measure(processor, build))
        if not found:
            print(f"{build} has no images for {processor}: nothing accepted", file=sys.stderr)
            return 1
        rows = {name: value for name, value in rows.items()
                if not name.startswith(f"{processor} ")}
        rows.update(found)
    ACCEPTED.write_text("".join(f"{name} {value:g}\n" for name, value in sorted(rows.items())),
                        encoding="utf-8")
    return 0


def fitting(kilobytes, real):
    """Side of a square tank, half full, and its particles, in so much RAM."""
    particle, cell = BYTES[real]
    side = 4
    while (side + 3) ** 2 * cell + 2 * (side + 1) ** 2 * particle + REST <= kilobytes * 1024:
        side += 1
    return side, 2 * side * side


def table(out_csv, builds):
    found = {}
    for processor, build in builds:
        found.update(measure(processor, build))
    with open(out_csv, "w", newline="", encoding="utf-8") as out:
        rows = csv.writer(out)
        rows.writerow(["name", "value", "unit", "target", "ok"])
        for name, value in found.items():
            unit = "bytes" if name.endswith(("code", "stack")) else "instructions/particle/substep"
            if name.endswith("cycles a step"):
                unit = "cycles"
            rows.writerow([name, value, unit, "", ""])
            print(f"{name:<44} {value:>9,} {unit}")
        cycles = found.get("cortex-m0 microbit example cycles a step")
        if cycles is not None:
            rate = EXAMPLE_MHZ * 1e6 / cycles
            good = rate >= EXAMPLE_TARGET
            rows.writerow(["microbit example with a solid", round(rate, 1), "steps/s",
                           EXAMPLE_TARGET, "yes" if good else "short"])
            print(f"\nmicrobit, 400 particles on 18 x 18 cells with a solid: {rate:.1f} steps/s at "
                  f"{EXAMPLE_MHZ} MHz, target {EXAMPLE_TARGET}: {'met' if good else 'short'}")
    print("\n| chip | tank, half full | particles | instructions a step | cycles a step | steps/s |")
    print("|---|---|---|---|---|---|")
    for title, processor, real, mhz, kilobytes in CHIPS:
        if f"{processor} {real} liquid instructions" not in found:
            continue
        side, particles = fitting(kilobytes, real)
        step = found[f"{processor} {real} liquid instructions"] * particles
        cycles = step * CYCLES.get(processor, 1)
        rate = f"{mhz * 1e6 / cycles:.0f}"
        if processor in CYCLES:
            told = f"{cycles / 1e6:.2f} M"
        else:
            told, rate = "not told", f"at most {rate}"
        print(f"| {title} | {side} × {side} | {particles:,} | {step / 1e6:.2f} M | {told} "
              f"| {rate} |")
    for title, particles, cells, rate in KNOWN:
        print(f"| other projects: {title} | {cells} | {particles} | | | {rate} |")
    return 0


def main():
    command = sys.argv[1] if len(sys.argv) > 1 else ""
    if command == "check" and len(sys.argv) == 4:
        return check(sys.argv[2], sys.argv[3])
    if command == "accept" and len(sys.argv) > 2:
        return accept([pair.split("=", 1) for pair in sys.argv[2:]])
    if command == "left_out" and len(sys.argv) > 3:
        return left_out(sys.argv[2], sys.argv[3:])
    if command == "table" and len(sys.argv) > 3:
        return table(sys.argv[2], [pair.split("=", 1) for pair in sys.argv[3:]])
    print(__doc__)
    return 64


if __name__ == "__main__":
    sys.exit(main())
