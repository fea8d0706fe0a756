"""Makes nonlinear.json: the non-linear sets of the NIST Statistical Reference Datasets
(https://www.itl.nist.gov/div898/strd/nls/nls_main.shtml, US public domain), from NIST's own text files (Misra1a.dat and
so on; their mirror in the public repository lmfit/lmfit-py, NIST_STRD, was read on 2026-11-21). Every number is NIST's,
kept as it is written there; nothing is computed here. The test confirms the copy: the certified parameters must give the
certified sum of squares on the data.
Run: python3 make_nonlinear.py FOLDER_WITH_DAT_FILES > nonlinear.json"""
import json
import pathlib
import re
import sys

number = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[Ee][-+]?\d+)?$")
out = {}
for path in sorted(pathlib.Path(sys.argv[1]).glob("*.dat")):
    text = path.read_text()
    level = re.search(r"(Lower|Average|Higher) Level of Difficulty", text).group(1).lower()
    starts, certified, deviations = [[], []], [], []
    for one, two, value, deviation in re.findall(r"b\d+\s*=\s*(\S+)\s+(\S+)\s+(\S+)\s+(\S+)", text):
        starts[0].append(float(one))
        starts[1].append(float(two))
        certified.append(float(value))
        deviations.append(float(deviation))
    rows = []
    for line in text[text.rindex("Data:"):].splitlines()[1:]:
        fields = line.split()
        if fields and all(number.match(f) for f in fields):
            rows.append([float(f) for f in fields])
    count = int(re.search(r"(\d+) Observations", text).group(1))
    assert len(rows) == count, (path.name, len(rows), count)
    assert len(certified) == int(re.search(r"(\d+) Parameters", text).group(1)), path.name
    out[path.stem] = {
        "level": level, "starts": starts, "certified": certified, "standard_errors": deviations,
        "square_sum": float(re.search(r"Residual Sum of Squares:\s*(\S+)", text).group(1)),
        "residual_deviation": float(re.search(r"Residual Standard Deviation:\s*(\S+)", text).group(1)),
        "y": [r[0] for r in rows], "x": [r[1:] for r in rows]}
print(json.dumps(out, separators=(",", ":")).replace('},"', '},\n"'))
