"""The programs as they were built carry what the build asked for: addresses that change from start to start, tables that
cannot be written once the program runs, no stack that can be executed, guarded stacks, checked string functions.

Usage: hardening_test.py"""

import os
import subprocess

PROGRAMS = ["zerodrift", "zerodrift-cli", "zerodrift-machine"]


def said(option, program):
    return subprocess.run(["readelf", "-W", option, program], check=True, capture_output=True, text=True).stdout


def look(program):
    kind = next(line for line in said("--file-header", program).splitlines() if "Type:" in line)
    assert "DYN (Position-Independent Executable file)" in kind, kind
    segments = {words[0]: words for words in (line.split() for line in said("--segments", program).splitlines()) if words}
    assert "GNU_RELRO" in segments, "the tables stay writable"
    assert segments["GNU_STACK"][-2] == "RW", segments["GNU_STACK"]
    dynamic = said("--dynamic", program)
    assert "BIND_NOW" in dynamic, "the tables are still filled while the program runs"
    symbols = {words[7].split("@")[0] for words in (line.split() for line in said("--dyn-syms", program).splitlines())
               if len(words) > 7}
    assert "__stack_chk_fail" in symbols, "no guard on the stack"
    checked = sorted(name for name in symbols if name.endswith("_chk"))
    assert checked, "no checked string functions"
    print(f"{os.path.basename(program)}: position independent, full RELRO, guarded stack, {', '.join(checked)}")


for name in PROGRAMS:
    look(os.path.join(os.environ["ZERODRIFT_BIN_DIR"], name))
