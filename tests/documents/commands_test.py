"""Commands in the documents give what stands below them, and the generated references are up to date.

A fenced block `console run` is run in a copy of examples/: each line "$ zerodrift-cli ..." with the lines it prints; `...`
stands for any lines. A block with a file name, such as `json names.json`, is written there first.

Usage: commands_test.py SOURCE_FOLDER PROGRAM_FOLDER"""

import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import textwrap

from pages import pages
from transcript import missing_line

ROOT, BIN = map(os.path.abspath, sys.argv[1:3])
BLOCK = re.compile(r"^([ ]*)```(\w+) (\S+)\n(.*?)^\1```$", re.M | re.S)
# What these print is judged by its first line; the figures below it change with the method.
BY_FIRST_LINE = ("diagnose", "prove")


def commands_of(block):
    """[(command, its lines)] of a console block."""
    found = []
    for line in block.rstrip("\n").split("\n"):
        if line.startswith("$ "):
            found.append((line[2:], []))
        else:
            found[-1][1].append(line)
    return found


def run(command, expected, folder):
    program, *arguments = shlex.split(command)
    assert program == "zerodrift-cli", command
    done = subprocess.run([os.path.join(BIN, program), *arguments], cwd=folder, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, timeout=300)
    seen = done.stdout.rstrip("\n").split("\n")
    if arguments[0] in BY_FIRST_LINE:
        seen, expected = seen[:1], expected[:1]
    missing = missing_line(seen, expected)
    if missing is None and done.returncode == 0:
        return []
    return [f"$ {command}\n  exit {done.returncode}, expected: {missing}\n  printed:\n" + textwrap.indent(done.stdout, "    ")]


def check(path):
    with open(path, encoding="utf-8") as file:
        blocks = BLOCK.findall(file.read())
    if not any(mark == "run" for _, _, mark, _ in blocks):
        return 0, []
    count, wrong = 0, []
    with tempfile.TemporaryDirectory() as temporary:
        folder = shutil.copytree(os.path.join(ROOT, "examples"), os.path.join(temporary, "examples"))
        for _, kind, mark, text in blocks:
            text = textwrap.dedent(text)
            if mark == "run":
                for command, expected in commands_of(text):
                    wrong += [f"{os.path.relpath(path, ROOT)}: {problem}" for problem in run(command, expected, folder)]
                    count += 1
            elif "." in mark:
                with open(os.path.join(folder, mark), "w", encoding="utf-8") as file:
                    file.write(text)
    return count, wrong


def main():
    total, wrong = 0, []
    for path in pages(ROOT):
        count, found = check(path)
        total += count
        wrong += found
    assert not wrong, "\n".join(wrong)
    assert total >= 20, total
    subprocess.run([sys.executable, os.path.join(ROOT, "scripts/make-cli-reference"), "--check", BIN], check=True)
    subprocess.run([sys.executable, os.path.join(ROOT, "scripts/make-effects-reference"), "--check"], check=True)
    print(f"{total} commands")


main()
