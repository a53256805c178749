"""The README's first C++ block is examples/first/main.cpp, byte for byte: check_readme.py ROOT"""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
block = re.search(r"```cpp\n(.*?)```", (root / "README.md").read_text(encoding="utf-8"), re.DOTALL)
source = (root / "examples/first/main.cpp").read_text(encoding="utf-8")
if block is None or block.group(1) != source:
    sys.exit("README.md: the example is not examples/first/main.cpp")
print("README.md: the example is the one that is compiled")
