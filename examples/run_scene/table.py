"""Prints one table from what run_scene said on the host and on a board: table.py HOST TARGET BOARD.

Exit status 1 if the two did not end in the same state.
"""
import sys


def read_facts(path):
    """name -> list of values; names of several words are joined: 'ticks step', 'memory grid'."""
    facts = {}
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            words = line.split()
            if not words:
                continue
            width = 2 if words[0] in ("ticks", "memory") else 1
            facts[" ".join(words[:width])] = words[width:]
    return facts


def thousands(text):
    return f"{int(text):,}"


def print_table(host, target, board):
    row = "{:<18} {:>15} {:>15}   {:>15} {:>15}".format
    fact = "{:<18} {}".format
    cells = " x ".join(host["cells"])
    print(fact("scene", f"{' '.join(host['scene'])}: {cells} cells, "
                        f"{thousands(host['particles'][0])} particles, {host['bodies'][0]} static "
                        f"and {host['bodies'][1]} moving bodies, {host['steps'][0]} steps "
                        f"({host['substeps'][0]} substeps)"))
    print()
    print("world bytes by owner")
    for name, values in host.items():
        if name.startswith("memory "):
            print(row("  " + name.split()[1], thousands(values[0]), "", "", ""))
    print(row("stack high-water", "", "", *(thousands(v) for v in target["stack"])).rstrip()
          + " reserved")
    print(row("code bytes", "", "", thousands(target["code"][0]), ""))
    print()
    print(row("", "this machine", host["unit"][0], board, target["unit"][0]))
    print(row("stage, per step", "mean", "worst", "mean", "worst"))
    for name, values in host.items():
        if name.startswith("ticks "):
            print(row("  " + name.split()[1], *map(thousands, values + target[name])))
    print()
    same = host["hash"] == target["hash"]
    digits = [run["hash"][0][2:] for run in (host, target)]
    print(fact("state hash", f"{digits[0]} on this machine, {digits[1]} on {board}: "
               + ("equal" if same else "DIFFERENT")))
    if any(run["clamped"] != ["0"] for run in (host, target)):
        print(fact("clamped", f"bits {host['clamped'][0]} (see weir/report.hpp)"))
    return same


def main():
    host, target = read_facts(sys.argv[1]), read_facts(sys.argv[2])
    for name, facts in (("this machine", host), (sys.argv[3], target)):
        if "hash" not in facts:
            print(f"{name}: the run did not finish: {facts.get('error', 'no reason given')}",
                  file=sys.stderr)
            return 1
    return 0 if print_table(host, target, sys.argv[3]) else 1


if __name__ == "__main__":
    sys.exit(main())
