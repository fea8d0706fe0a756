"""examples/run-all.sh runs, and prints what examples/expected.txt holds: the same words, numbers within 2 %.

The diagnosis is compared by its verdict and its effect, not by its digits.

Usage: examples_test.py SOURCE_FOLDER"""

import json
import os
import subprocess
import sys
import tempfile

from transcript import same_line

ROOT = os.path.abspath(sys.argv[1])
# Commands of which only the result files are looked at.
BY_RESULT = ("diagnose", "prove")
MOST_BYTES = 3_000_000


def by_command(transcript):
    """Command line -> lines of its output."""
    outputs = {}
    command = None
    for line in transcript.splitlines():
        if line.startswith("$ zerodrift-cli "):
            command = line[len("$ zerodrift-cli "):]
            outputs[command] = []
        elif line and not line.startswith("## "):
            outputs[command].append(line)
    return outputs


def differences(seen, expected):
    found = [f"only on one side: {command}" for command in set(seen) ^ set(expected)]
    for command, lines in expected.items():
        if command.split()[0] in BY_RESULT or command not in seen:
            continue
        if len(lines) != len(seen[command]):
            found.append(f"{command}: {len(seen[command])} lines, expected {len(lines)}")
        found += [f"{command}:\n  printed  {a}\n  expected {b}" for a, b in zip(seen[command], lines) if not same_line(a, b)]
    return found


def diagnosis_names_the_coolant(folder):
    with open(os.path.join(folder, "out/diagnosis.json"), encoding="utf-8") as file:
        diagnosis = json.load(file)
    assert diagnosis["verdict"] == "missing_effect", diagnosis["verdict"]
    assert "coolant" in [effect["id"] for effect in diagnosis["effects"]], diagnosis["effects"]


def size_of(folder):
    return sum(os.path.getsize(os.path.join(path, name)) for path, _, names in os.walk(folder) for name in names)


def main():
    examples = os.path.join(ROOT, "examples")
    assert size_of(examples) < MOST_BYTES, size_of(examples)
    with open(os.path.join(examples, "expected.txt"), encoding="utf-8") as file:
        expected = by_command(file.read())
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([os.path.join(examples, "run-all.sh"), folder], capture_output=True, text=True, timeout=500)
        assert done.returncode == 0, (done.returncode, done.stdout[-2000:], done.stderr)
        found = differences(by_command(done.stdout), expected)
        assert not found, "\n".join(found) + "\nIf intended: examples/run-all.sh > examples/expected.txt"
        diagnosis_names_the_coolant(folder)


main()
