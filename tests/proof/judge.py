#!/usr/bin/env python3
"""Diagnoses every case of the folders given and scores the answers against their expected.json.

    judge.py --cli zerodrift-cli --out RESULT_DIR [--expected DIR] [--jobs 2] CASES_DIR ...

A case is a folder with machine.json, r1.csv and perhaps r2.csv, ...; its expected.json stands beside them or as
DIR/<case>.json. Answers, refined machines and result.json go to RESULT_DIR; what is there already is not diagnosed
again unless --again is given.

expected.json
    hidden          list of effects: name, right (ids that are right), half (ids that are acceptable: text, or
                    {"id", "max_confidence"}), and where known component, position_mm with tolerance_mm, channel,
                    driver, intervals_s of the first recording; required: an answer without it is wrong
    unlisted        true: no effect is right, "unexplained" is
    right_verdicts  verdicts that are right by themselves, without any effect
    tolerated       ids that are neither right nor wrong beside the others
    honest          what an "unexplained" has to point at to count as honest: intervals_s, channels

Outcome of a case
    right   every hidden effect is named and no other (none hidden: "consistent" and no effect)
    first   the first effect is right, the list is not complete or too long
    half    an acceptable effect comes first, or the right one in another place, or one of two
    honest  "unexplained" and no wrong effect of 0.8 or more
    missed  "consistent" although something is hidden
    wrong   anything else; sure and wrong: a wrong effect of 0.9 or more
    failed  no answer: refused, or out of time
"""

import argparse
import concurrent.futures
import csv
import json
import math
import os
import pathlib
import resource
import signal
import statistics
import subprocess
import sys
import time

SURE = 0.9
ALARM = 0.5  # from here an effect of a machine with nothing hidden is a false alarm, whatever the verdict
COUNTS = 0.8  # a wrong effect below this does not spoil an "unexplained"
OVERLAP = 0.3  # of intervals, intersection over union
SCORE = {"right": 1.0, "first": 1.0, "half": 0.5, "honest": 0.5}


# ---------------------------------------------------------------------------------------------- running


def run(command, limit_s):
    """Exit code, processor seconds, wall seconds, and the last line said; limit in processor seconds."""
    limit = (int(limit_s), int(limit_s) + 5)
    began = time.monotonic()
    process = subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, limit),
    )
    said = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    lines = [line for line in said.strip().split("\n") if line] or [""]
    if process.returncode == -signal.SIGXCPU:
        lines.append(f"stopped after {limit_s:.0f} s of processor time")
    return process.returncode, usage.ru_utime + usage.ru_stime, time.monotonic() - began, lines[-1]


def recordings_of(folder):
    return sorted(folder.glob("r[0-9]*.csv"))


def diagnose(cli, folder, out, limit_s):
    out.mkdir(parents=True, exist_ok=True)
    command = cli + ["diagnose", "--machine", folder / "machine.json"]
    for recording in recordings_of(folder):
        command += ["--recording", recording]
    command += ["--out", out / "diagnosis.json", "--refined", out / "refined.json"]
    (out / "diagnosis.json").unlink(missing_ok=True)
    code, processor_s, wall_s, said = run([str(word) for word in command], limit_s)
    facts = {"exit": code, "processor_s": processor_s, "wall_s": wall_s, "said": said}
    (out / "run.json").write_text(json.dumps(facts))


def read_columns(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    columns = {}
    for i, name in enumerate(rows[0]):
        columns[name] = [float(row[i]) if i < len(row) and row[i] else math.nan for row in rows[1:]]
    return columns


def spread(prediction, recording):
    """rms of the difference about its mean: a sensor's offset is of one recording and not the machine's."""
    pairs = [p - r for p, r in zip(prediction, recording) if not math.isnan(p) and not math.isnan(r)]
    if not pairs:
        return math.nan
    mean = sum(pairs) / len(pairs)
    return math.sqrt(sum((x - mean) ** 2 for x in pairs) / len(pairs))


def refined_check(cli, folder, out, diagnosis):
    """How the refined machine reproduces what was reported: worst simulated spread over the reported rms."""
    reported = diagnosis.get("rmse", {})
    worst = 0.0
    for i, recording in enumerate(recordings_of(folder)[:2]):
        after = reported.get("after" if i == 0 else "held_out_after") or {}
        target = out / f"prediction{i + 1}.csv"
        target.unlink(missing_ok=True)
        run([str(w) for w in cli + ["simulate", "--machine", out / "refined.json", "--inputs", recording, "--out", target]], 120)
        if not target.exists():
            return math.inf
        predicted, measured = read_columns(target), read_columns(recording)
        times = {t: row for row, t in enumerate(measured["time_s"])}
        rows = [(j, times[t]) for j, t in enumerate(predicted["time_s"]) if t in times]
        for channel, rms in after.items():
            if channel not in predicted or channel not in measured or rms is None:
                continue
            here = spread([predicted[channel][j] for j, _ in rows], [measured[channel][k] for _, k in rows])
            floor = 0.2 if channel.endswith("_um") else 0.02
            if math.isnan(here):
                return math.inf
            worst = max(worst, here / max(rms, floor))
    return worst


# ---------------------------------------------------------------------------------------------- scoring


def length(intervals):
    return sum(b - a for a, b in intervals)


def overlap(first, second):
    """Intersection over union of two lists of intervals; None where either is empty."""
    if not first or not second:
        return None
    both = sum(max(0.0, min(b, d) - max(a, c)) for a, b in first for c, d in second)
    union = length(first) + length(second) - both
    return both / union if union > 0 else 0.0


def intervals_of(effect):
    intervals = effect.get("intervals_s")
    if intervals:
        return intervals
    parameters = effect.get("parameters") or {}
    if isinstance(parameters, list):
        return [[p["from_s"], p["to_s"]] for p in parameters if "from_s" in p and "to_s" in p]
    if "from_s" in parameters and "to_s" in parameters:
        return [[parameters["from_s"], parameters["to_s"]]]
    return parameters.get("intervals_s") or []


def place_error(effect, hidden):
    if effect.get("position_mm") is None or hidden.get("position_mm") is None:
        return None
    if hidden.get("component") and effect.get("component") not in (None, hidden["component"]):
        return None
    place = effect["position_mm"]
    return abs((sum(place) / len(place) if isinstance(place, list) else place) - hidden["position_mm"])


def match(effect, hidden):
    """"right", "half" or "" of a named effect against a hidden one."""
    same_component = not hidden.get("component") or effect.get("component") in (None, hidden["component"])
    same_channel = not hidden.get("channel") or effect.get("channel") in (None, "", hidden["channel"])
    if effect["id"] in hidden["right"]:
        if not same_component or not same_channel:
            return ""
        error = place_error(effect, hidden)
        if error is not None and error > hidden.get("tolerance_mm", math.inf):
            return "half"
        shared = overlap(intervals_of(effect), hidden.get("intervals_s"))
        if shared is not None and shared < OVERLAP:
            return "half"
        return "right"
    for other in hidden.get("half", []):
        limit = other.get("max_confidence", 1.0) if isinstance(other, dict) else 1.0
        name = other["id"] if isinstance(other, dict) else other
        if effect["id"] != name or effect["confidence"] > limit:
            continue
        if not same_component and effect.get("component") != hidden.get("half_component"):
            return ""
        if effect.get("channel") and not same_channel:
            return ""
        return "half"
    return ""


def honest(expected, diagnosis):
    """An "unexplained" that points where it should."""
    if diagnosis.get("verdict") != "unexplained":
        return False
    wanted = expected.get("honest", {})
    mismatch = diagnosis.get("mismatch") or {}
    channels = [c for c in diagnosis.get("channels") or [] if isinstance(c, dict) and c.get("verdict") == "unexplained"]
    if wanted.get("channels"):
        named = set(mismatch.get("channels") or []) | {c["channel"] for c in channels}
        if named and not named & set(wanted["channels"]):
            return False
    if wanted.get("intervals_s"):
        told = list(mismatch.get("time_s") or [])
        for channel in channels:
            told += channel.get("time_s") or []
        return any(min(b, d) > max(a, c) for a, b in told for c, d in wanted["intervals_s"])
    return True


def left_unexplained(diagnosis, channel):
    channels = [c for c in diagnosis.get("channels") or [] if isinstance(c, dict) and c.get("verdict") == "unexplained"]
    return diagnosis.get("verdict") == "unexplained" or any(channel in (None, c["channel"]) for c in channels)


def judge(expected, diagnosis):
    effects = diagnosis.get("effects") or []
    hidden = expected["hidden"]
    tolerated = set(expected.get("tolerated", []))
    classes, best = [], [""] * len(hidden)
    places, overlaps = [], []
    for effect in effects:
        kinds = [match(effect, h) for h in hidden]
        kind = "right" if "right" in kinds else "half" if "half" in kinds else "tolerated" if effect["id"] in tolerated else "wrong"
        classes.append(kind)
        for i, k in enumerate(kinds):
            if k == "right" or (k == "half" and best[i] == ""):
                best[i] = k
            if k and effect["id"] in hidden[i]["right"]:
                error = place_error(effect, hidden[i])
                if error is not None:
                    places.append(error)
                shared = overlap(intervals_of(effect), hidden[i].get("intervals_s"))
                if shared is not None:
                    overlaps.append(shared)
    for i, h in enumerate(hidden):
        # Nothing names it: what is right is to leave it unexplained.
        if not h["right"] and not expected.get("unlisted") and left_unexplained(diagnosis, h.get("channel")):
            best[i] = "right"
    named = [k for k in classes if k != "tolerated"]
    wrong = [e["confidence"] for e, k in zip(effects, classes) if k == "wrong"]
    verdict = diagnosis.get("verdict")
    unexplained = honest(expected, diagnosis)
    spoiled = any(c >= COUNTS for c in wrong)
    if not hidden and not expected.get("unlisted"):
        alarm = verdict == "missing_effect" or any(c >= ALARM for c in wrong)
        outcome = "wrong" if alarm else "right" if verdict == "consistent" else "honest"
    elif expected.get("unlisted") or verdict in expected.get("right_verdicts", []):
        good = unexplained and not spoiled
        outcome = "right" if good else "half" if "half" in named or "right" in named else "wrong"
        if not expected.get("unlisted") and named and set(named) <= {"right"}:
            outcome = "right"
        if verdict == "consistent" and not effects:
            outcome = "missed"
        elif verdict == "unexplained" and not spoiled and outcome == "wrong":
            outcome = "honest"
    elif named and named[0] == "right":
        outcome = "right" if all(b == "right" for b in best) and "wrong" not in named else "first"
    elif "right" in named or "half" in named:
        outcome = "half" if not any(c >= SURE for c in wrong) else "wrong"
    elif verdict == "consistent":
        outcome = "missed"
    elif unexplained and not spoiled:
        outcome = "honest"
    else:
        outcome = "wrong"
    if any(h.get("required") and not b for h, b in zip(hidden, best)) and verdict != "unexplained":
        outcome = "wrong"
    return {
        "outcome": outcome,
        "verdict": verdict,
        "answer": [f"{e['id']}{'@' + str(e['channel'] or e['component']) if e.get('channel') or e.get('component') else ''} {e['confidence']:.2f}" for e in effects],
        "confidence": [[e["confidence"], k] for e, k in zip(effects, classes) if k != "tolerated"],
        "sure_and_wrong": any(c >= SURE for c in wrong),
        "wrong_confidence": max(wrong, default=0.0),
        "found": [b for b in best],
        "place_mm": places,
        "overlap": overlaps,
    }


def judge_folder(arguments, folder, result):
    expected_path = folder / "expected.json"
    if arguments.expected and (arguments.expected / f"{folder.name}.json").exists():
        expected_path = arguments.expected / f"{folder.name}.json"
    expected = json.loads(expected_path.read_text())
    out = arguments.out / folder.parent.name / folder.name
    if arguments.again or not (out / "run.json").exists():
        diagnose(arguments.cli, folder, out, arguments.limit_s)
    facts = json.loads((out / "run.json").read_text())
    if facts["exit"] != 0 or not (out / "diagnosis.json").exists():
        said = {"outcome": "failed", "verdict": f"failed ({facts['exit']})", "answer": [facts["said"][:100]], "confidence": []}
        said.update(sure_and_wrong=False, wrong_confidence=0.0, found=[], place_mm=[], overlap=[])
    else:
        diagnosis = json.loads((out / "diagnosis.json").read_text())
        said = judge(expected, diagnosis)
        if not arguments.quick:
            said["refined_over_reported"] = refined_check(arguments.cli, folder, out, diagnosis)
    hidden = [h["name"] for h in expected["hidden"]] or ["none"]
    said.update(case=folder.name, world=expected.get("world", folder.parent.name), hidden="+".join(hidden))
    said.update(unlisted=bool(expected.get("unlisted")), recordings=len(recordings_of(folder)))
    said.update(structure=expected.get("structure", ""), strength=[h.get("strength_sigma") for h in expected["hidden"]])
    said.update(processor_s=facts["processor_s"], wall_s=facts["wall_s"], path=str(folder))
    result.append(said)
    print(line_of(said), flush=True)


def line_of(one):
    strength = "/".join(f"{s:.0f}" for s in one["strength"] if s) or "-"
    mark = " SURE AND WRONG" if one["sure_and_wrong"] else ""
    refined = one.get("refined_over_reported")
    poor = f" refined x{refined:.2f}" if refined is not None and refined > 1.15 else ""
    return (
        f"{one['outcome']:7} {one['case'][:44]:44} {one['hidden'][:34]:34} {strength:>6} sigma {one['recordings']} run "
        f"{one['processor_s']:6.1f} s  {one['verdict']}: {', '.join(one['answer']) or '-'}{mark}{poor}"
    )


# ---------------------------------------------------------------------------------------------- figures


def calibration(judged):
    """Bins of stated confidence against how often the effect was right (half: 0.5), and their expected error."""
    pairs = [(c, 1.0 if k == "right" else 0.5 if k == "half" else 0.0) for one in judged for c, k in one["confidence"]]
    bins, error = [], 0.0
    for low in (0.0, 0.5, 0.6, 0.7, 0.8, 0.9, 0.97):
        high = {0.0: 0.5, 0.9: 0.97, 0.97: 1.01}.get(low, low + 0.1)
        inside = [(c, r) for c, r in pairs if low <= c < high]
        if inside:
            stated = statistics.mean(c for c, _ in inside)
            right = statistics.mean(r for _, r in inside)
            bins.append({"from": low, "stated": stated, "right": right, "effects": len(inside)})
            error += len(inside) / len(pairs) * abs(stated - right)
    return bins, error


def share(cases, outcomes):
    return [sum(one["outcome"] in outcomes for one in cases), len(cases)]


def figures(judged):
    single = [j for j in judged if j["hidden"] != "none" and "+" not in j["hidden"] and not j["unlisted"]]
    pairs = [j for j in judged if "+" in j["hidden"]]
    sound = [j for j in judged if j["hidden"] == "none"]
    unlisted = [j for j in judged if j["unlisted"]]
    listed = single + pairs
    bins, error = calibration(judged)
    seconds = sorted(j["processor_s"] for j in judged)
    places = [p for j in judged for p in j["place_mm"]]
    overlaps = [o for j in judged for o in j["overlap"]]
    refined = [j["refined_over_reported"] for j in judged if "refined_over_reported" in j]
    return {
        "cases": len(judged),
        "score": statistics.mean(SCORE.get(j["outcome"], 0.0) for j in judged),
        "listed, first effect right": share(listed, ("right", "first")),
        "listed, all right": share(listed, ("right",)),
        "single, right": share(single, ("right", "first")),
        "single, right or half": share(single, ("right", "first", "half")),
        "single, honest": share(single, ("honest",)),
        "single, missed": share(single, ("missed",)),
        "single, wrong": share(single, ("wrong",)),
        "failed": share(judged, ("failed",)),
        "pairs, both": share(pairs, ("right",)),
        "pairs, one at least": share(pairs, ("right", "first", "half")),
        "nothing hidden, consistent": share(sound, ("right",)),
        "nothing hidden, given up": share(sound, ("honest",)),
        "nothing hidden, false alarms": share(sound, ("wrong",)),
        "unlisted, unexplained": share(unlisted, ("right",)),
        "sure and wrong": [sum(j["sure_and_wrong"] for j in judged), len(judged)],
        "place, median and worst mm": [statistics.median(places), max(places), len(places)] if places else [],
        "intervals, median overlap": [statistics.median(overlaps), len(overlaps)] if overlaps else [],
        "calibration": bins,
        "calibration error": error,
        "refined worse than reported by 15 %": [sum(r > 1.15 for r in refined), len(refined)],
        "processor s, median, nine of ten, worst": [seconds[len(seconds) // 2], seconds[int(0.9 * (len(seconds) - 1))], seconds[-1]]
        if seconds
        else [],
    }


def print_figures(title, figure):
    print(f"\n{title}")
    for key, value in figure.items():
        if key == "calibration":
            for one in value:
                print(f"  {'stated ' + format(one['stated'], '.2f'):44} right {one['right']:.2f} ({one['effects']})")
        elif isinstance(value, list) and len(value) == 2 and all(isinstance(v, int) for v in value):
            if value[1]:
                print(f"  {key:44} {value[0]} of {value[1]} = {100 * value[0] / value[1]:.0f} %")
        elif isinstance(value, list):
            if value:
                print(f"  {key:44} {', '.join(format(v, '.4g') for v in value)}")
        else:
            print(f"  {key:44} {value:.3g}")


def table_by_kind(judged):
    kinds = sorted({j["hidden"] for j in judged if "+" not in j["hidden"]})
    order = ("right", "first", "half", "honest", "missed", "wrong", "failed")
    print(f"\n  {'hidden':34}" + "".join(f"{o:>8}" for o in order))
    for kind in kinds + ["two effects"]:
        these = [j for j in judged if j["hidden"] == kind or (kind == "two effects" and "+" in j["hidden"])]
        if these:
            print(f"  {kind[:34]:34}" + "".join(f"{sum(j['outcome'] == o for j in these):8}" for o in order))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cli", required=True, help="zerodrift-cli; several words are a command in front of it")
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--expected", type=pathlib.Path, help="folder of <case>.json, before the case's own")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--limit-s", type=float, default=300.0, help="processor seconds a case")
    parser.add_argument("--again", action="store_true", help="diagnose also what RESULT_DIR has an answer to")
    parser.add_argument("--quick", action="store_true", help="do not simulate the refined machines")
    parser.add_argument("folders", type=pathlib.Path, nargs="+")
    arguments = parser.parse_args()
    arguments.cli = arguments.cli.split()
    cases = []
    for folder in arguments.folders:
        found = [folder] if (folder / "machine.json").exists() else sorted(p.parent for p in folder.glob("*/machine.json"))
        if not found:
            sys.exit(f"{folder}: no case (a folder with machine.json)")
        cases += [f.resolve() for f in found]
    arguments.out.mkdir(parents=True, exist_ok=True)
    judged = []
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for done in [pool.submit(judge_folder, arguments, case, judged) for case in cases]:
            done.result()
    judged.sort(key=lambda one: (one["world"], one["case"]))
    worlds = sorted({one["world"] for one in judged})
    result = {"cases": judged, "figures": {}}
    for world in worlds + (["all"] if len(worlds) > 1 else []):
        these = [one for one in judged if world in (one["world"], "all")]
        result["figures"][world] = figures(these)
        print_figures(world, result["figures"][world])
        table_by_kind(these)
    (arguments.out / "result.json").write_text(json.dumps(result, indent=1))


if __name__ == "__main__":
    main()
