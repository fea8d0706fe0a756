"""Makes linear.json: the linear sets of the NIST Statistical Reference Datasets (https://www.itl.nist.gov/div898/strd/,
US public domain). The observations are NIST's; the certified values are the exact least-squares solution of those
decimal observations, solved here in rational arithmetic and rounded to 16 digits (NIST certifies 15).
Run: python3 make_linear.py observations.json > linear.json, where observations.json is linear.json or any file
{name: {"level", "degree" or null, "intercept", "y": [...], "x": [[...], ...]}} with numbers as decimal strings."""
import decimal
import json
import sys
from decimal import Decimal
from fractions import Fraction

decimal.getcontext().prec = 60


def root(f):
    return float((Decimal(f.numerator) / Decimal(f.denominator)).sqrt())


def solve(a, b):
    n = len(a)
    m = [row[:] + [Fraction(int(i == j)) for j in range(n)] + [b[i]] for i, row in enumerate(a)]
    for i in range(n):
        p = next(r for r in range(i, n) if m[r][i] != 0)
        m[i], m[p] = m[p], m[i]
        m[i] = [v / m[i][i] for v in m[i]]
        for r in range(n):
            if r != i and m[r][i] != 0:
                factor = m[r][i]
                m[r] = [v - factor * w for v, w in zip(m[r], m[i])]
    return [row[-1] for row in m], [[row[n + j] for j in range(n)] for row in m]


out = {}
for name, s in json.load(open(sys.argv[1])).items():
    y = [Fraction(v) for v in s["y"]]
    x = [[Fraction(v) for v in row] for row in s["x"]]
    rows = []
    for r in x:
        terms = [r[0] ** k for k in range(1, s["degree"] + 1)] if s["degree"] else r
        rows.append(([Fraction(1)] if s["intercept"] else []) + terms)
    p = len(rows[0])
    normal = [[sum(r[i] * r[j] for r in rows) for j in range(p)] for i in range(p)]
    beta, inverse = solve(normal, [sum(r[i] * v for r, v in zip(rows, y)) for i in range(p)])
    rss = sum((v - sum(b * c for b, c in zip(beta, r))) ** 2 for r, v in zip(rows, y))
    variance = rss / (len(y) - p)
    mean = sum(y) / len(y) if s["intercept"] else Fraction(0)
    total = sum((v - mean) ** 2 for v in y)
    out[name] = {**s, "coefficients": [float(b) for b in beta],
                 "standard_errors": [root(variance * inverse[i][i]) for i in range(p)],
                 "residual_deviation": root(variance), "r_squared": float(1 - rss / total)}
print(json.dumps(out, indent=None, separators=(",", ":")).replace('},"', '},\n"'))
