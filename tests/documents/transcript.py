"""Comparing what a program prints with what a document says it prints: the same words, numbers within 2 %."""

import re

NUMBER = re.compile(r"[+-]?\d+(?:\.\d+)?")


def same_line(seen, expected):
    if NUMBER.sub("#", seen.rstrip()) != NUMBER.sub("#", expected.rstrip()):
        return False
    pairs = zip(NUMBER.findall(seen), NUMBER.findall(expected))
    return all(abs(float(a) - float(b)) <= max(0.02 * abs(float(b)), 0.02) for a, b in pairs)


def missing_line(seen, expected):
    """The first expected line that is not in its place, or nothing. `...` stands for any lines."""
    at = 0
    skip = False
    for line in expected:
        if line.strip() == "...":
            skip = True
            continue
        while skip and at < len(seen) and not same_line(seen[at], line):
            at += 1
        if at >= len(seen) or not same_line(seen[at], line):
            return line
        at += 1
        skip = False
    return None if skip or at == len(seen) else f"nothing more, but printed was: {seen[at]}"
