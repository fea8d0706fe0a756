#!/usr/bin/env python3
"""Cases from real recordings: an input that was logged is taken away, so that the answer is known.

    withheld_inputs.py --out DIR

Reads the recordings from ZERODRIFT_DATA_DIR (default: ../shared/data beside the project) and writes cases for judge.py.
Nothing of the recordings is part of this repository. Two variants of each recording:

    withheld     neither the description nor the recording has the input
    undescribed  the recording has its column, the description has no source for it
"""

import argparse
import csv
import json
import os
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]


def data_folder():
    return pathlib.Path(os.environ.get("ZERODRIFT_DATA_DIR") or ROOT.parent / "shared" / "data")


def read(path):
    with open(path, newline="", encoding="utf-8-sig") as file:
        rows = list(csv.reader(file))
    return rows[0], rows[1:]


def write(path, head, rows):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(head)
        writer.writerows(rows)


def without(head, rows, columns):
    kept = [i for i, name in enumerate(head) if name not in columns]
    return [head[i] for i in kept], [[row[i] for i in kept] for row in rows]


def on_intervals(head, rows, column, share=0.5):
    """Where the input is above this share of its largest value; from its sample to the next."""
    time, value = head.index("time_s"), head.index(column)
    samples = [(float(row[time]), float(row[value] or 0)) for row in rows]
    limit = share * max(v for _, v in samples)
    intervals = []
    for (start, level), (end, _) in zip(samples, samples[1:]):
        if level > limit:
            if intervals and intervals[-1][1] == start:
                intervals[-1][1] = end
            else:
                intervals.append([start, end])
    return intervals


def drop_sources(machine, columns):
    for component in machine["components"]:
        sources = component.get("heat_sources", [])
        component["heat_sources"] = [s for s in sources if s.get("channel") not in columns]
        if not component["heat_sources"]:
            component.pop("heat_sources")


def describe_film(machine, **parameters):
    machine["effects"] = ["convection"]
    machine["effect_parameters"] = {"convection": parameters}


# Edits of a description, so that only the input is missing: figures of the authors or of a study by hand.


def rod_with_film(machine):
    describe_film(machine, h_W_m2K=12.0)
    machine["tolerances"]["film"] = 0.3


def box_described(machine):
    machine["components"] = [{"id": "box", "kind": "lump", "heat_capacity_J_K": 600}]
    describe_film(machine, conductance_W_K=0.6, component="box")
    machine["tolerances"] = {"heat_capacity": 0.3, "film": 0.3}


def board_described(machine):
    if not machine["couplings"]:
        machine["couplings"] = [
            {"between": [{"component": "heater1"}, {"component": "heater2"}], "conductance_W_K": 0.006}
        ]
        describe_film(machine, h_W_m2K=10.0)
        machine["tolerances"] = {"heat_capacity": 0.5, "film": 0.4, "conductance": 0.6}


def bed_free(machine):
    """The bed is a body of its own that the chamber cools; what heats it is missing."""
    for component in machine["components"]:
        if component["id"] == "bed":
            component.pop("prescribed", None)
            component["heat_capacity_J_K"] = 2500
    machine["tolerances"] = {"heat_capacity": 0.5}
    machine["couplings"].append({"between": [{"component": "bed"}, {"component": "chamber"}], "conductance_W_K": None})


def bed_gone(machine):
    machine["components"] = [c for c in machine["components"] if c["id"] != "bed"]
    machine["sensors"] = [s for s in machine["sensors"] if s["component"] != "bed"]


def spindle_part(channels, fluids):
    """A few of the 16 sensors: those that speed or chiller reach, and one that they hardly do."""

    def edit(machine):
        parts = {s["component"] for s in machine["sensors"] if s["channel"] in channels}
        machine["components"] = [c for c in machine["components"] if c["id"] in parts]
        machine["sensors"] = [s for s in machine["sensors"] if s["channel"] in channels or s["component"] == "ambient"]
        machine["displacements"] = []
        if not fluids:
            machine.pop("fluids")

    return edit


def heat(component, half=("standing_heat", "extra_heat_source", "neighbour_heat"), **facts):
    """What a heater is that nobody logged."""
    return {"name": "switched_heat", "right": ["switched_heat"], "half": list(half), "component": component, **facts}


def steady_heat(component):
    """On from the first sample to the last."""
    right = ["standing_heat", "switched_heat", "extra_heat_source"]
    return {"name": "standing_heat", "right": right, "half": ["neighbour_heat"], "component": component}


def case(name, folder, recordings, columns, hidden, edit=None, sources=None, on_share=0.5, **expected):
    """`columns`: taken out of the recordings; `sources`: channels whose sources are not described (default: the same)."""
    return {
        "name": name,
        "folder": folder,
        "recordings": recordings,
        "columns": columns,
        "sources": columns if sources is None else sources,
        "hidden": hidden,
        "edit": edit,
        "on_share": on_share,
        "expected": expected,
    }


UNEXPLAINED = {"right_verdicts": ["unexplained"]}
LID, HEATER_BODY, NO_HEATER = "01-incubator-lid-opened-once", "05-incubator-heater-has-a-body", "heater_on"
ROD_BESIDE = {"tolerated": ["heater_body", "contact_resistance", "sensor_lag", "radiation"]}

CASES = [
    case("rod-6-7-heater", "aluminium-rod", ["rod_6_7.csv"], [NO_HEATER], [heat("rod", position_mm=0, tolerance_mm=30)], rod_with_film, **ROD_BESIDE),
    case("rod-6-9-heater", "aluminium-rod", ["rod_6_9.csv"], [NO_HEATER], [heat("rod", position_mm=0, tolerance_mm=30)], rod_with_film, **ROD_BESIDE),
    case("rod-both-heater", "aluminium-rod", ["rod_6_9.csv", "rod_6_7.csv"], [NO_HEATER], [heat("rod", position_mm=0, tolerance_mm=30)], rod_with_film, **ROD_BESIDE),
    case("rod-lying-heater", "concealed/09-rod-lying-twice", ["r1.csv", "r2.csv"], [NO_HEATER], [heat("rod", position_mm=0, tolerance_mm=30)], rod_with_film, **ROD_BESIDE),
    case("board-first-heater", "heater-board", ["board_step_first_400s.csv"], ["Q1_percent"], [steady_heat("heater1")], board_described, tolerated=["sensor_lag", "heater_body"]),
    case("board-both-heater", "heater-board", ["board_step_first_400s.csv", "board_step_rest.csv"], ["Q1_percent"], [steady_heat("heater1")], board_described, tolerated=["sensor_lag", "heater_body"]),
    case("board-24-second-heater", "concealed/24-board-heater-weaker-than-logged", ["r1.csv"], ["Q2_percent"], [steady_heat("heater2")], board_described, tolerated=["sensor_lag", "heater_body", "switched_heat"]),
    case("board-23-second-heater", "concealed/23-board-sensor-reads-low-for-a-while", ["r1.csv"], ["Q2_percent"], [steady_heat("heater2")], board_described, tolerated=["sensor_lag", "heater_body", "sensor_offset", "switched_heat"]),
    case("gantry-bed-heater", "gantry-drift", ["gantry_B.csv"], ["bed_heater_on"], [heat("bed")], bed_free, tolerated=["convection", "structure_driver", "structure_lag", "casting_core", "radiation"]),
    case(
        "gantry-bed", "gantry-drift", ["gantry_B.csv"], ["bed_heater_on", "bed_C"],
        [{"name": "convection", "right": ["convection"], "half": [], "component": "frame"}],
        bed_gone,
        sources=[],
        weak=["structure_driver", "structure_lag"],
    ),
    case(
        "spindle-speed", "spindle-drift", ["spindle_drift.csv"], ["spindle_rpm"],
        [heat(None)],
        spindle_part(["t1_C", "t2_C", "t3_C", "t5_C", "t6_C"], True),
        on_share=0.05,
        tolerated=["convection", "coolant", "casting_core"],
    ),
    case(
        "spindle-chiller", "spindle-drift", ["spindle_drift.csv"], ["t4_C"],
        [{"name": "chiller", "right": ["coolant", "chiller_cycle"], "half": ["neighbour_heat", "draught", "standing_heat"]}],
        spindle_part(["t1_C", "t2_C", "t3_C", "t6_C"], False),
        sources=[],
        tolerated=["convection", "casting_core"],
        **UNEXPLAINED,
    ),
    case("box-closed-heater", "concealed/" + LID, ["r2.csv"], [NO_HEATER], [heat(None)], None, tolerated=["casting_core", "heater_body", "sensor_lag"]),
    case("box-lid-heater", "concealed/" + LID, ["r1.csv", "r2.csv"], [NO_HEATER], [heat(None)], None, tolerated=["casting_core", "heater_body", "sensor_lag", "draught"]),
    case("box-long-heater", "concealed/30-incubator-lid-late-in-a-long-run", ["r1.csv"], [NO_HEATER], [heat(None)], None, tolerated=["casting_core", "heater_body", "sensor_lag", "draught"]),
    case("box-random-heater", "concealed/" + HEATER_BODY, ["r1.csv"], [NO_HEATER], [heat("box")], box_described, tolerated=["casting_core", "heater_body", "sensor_lag"]),
    case("box-ramp-heater", "concealed/" + HEATER_BODY, ["r2.csv"], [NO_HEATER], [heat("box")], box_described, tolerated=["casting_core", "heater_body", "sensor_lag"]),
    case("box-both-heater", "concealed/" + HEATER_BODY, ["r1.csv", "r2.csv"], [NO_HEATER], [heat("box")], box_described, tolerated=["casting_core", "heater_body", "sensor_lag"]),
    case("pi-load", "concealed/11-pi-closed-case-warms-up", ["r1.csv"], ["usage_percent"], [heat("cpu")], None, tolerated=["convection", "casting_core", "standing_heat"]),
    case("pi-both-load", "concealed/11-pi-closed-case-warms-up", ["r1.csv", "r2.csv"], ["usage_percent"], [heat("cpu")], None, tolerated=["convection", "casting_core", "standing_heat"]),
    case("cooler-power", "concealed/12-cpu-cooler-fan-withheld", ["r1.csv"], ["power_W"], [heat("cooler")], None, tolerated=["draught", "standing_heat"]),
    case("nozzle-heater", "concealed/14-hotend-late-sensor", ["r1.csv"], ["heater_duty"], [heat("nozzle")], None, tolerated=["convection", "sensor_lag", "heater_body", "casting_core"]),
]


def build(one, data, out, undescribed):
    source = data / one["folder"]
    missing = [n for n in ["machine.json"] + one["recordings"] if not (source / n).exists()]
    if missing:
        print(f"skipped {one['name']}: {source} has no {', '.join(missing)}")
        return False
    machine = json.loads((source / "machine.json").read_text())
    drop_sources(machine, one["sources"])
    if one["edit"]:
        one["edit"](machine)
    name = one["name"] + ("-undescribed" if undescribed else "")
    machine["name"] = name.replace("-", " ")
    folder = out / name
    folder.mkdir(parents=True, exist_ok=True)
    hidden = [dict(h) for h in one["hidden"]]
    for i, recording in enumerate(one["recordings"]):
        head, rows = read(source / recording)
        if i == 0 and one["columns"][0] in head:
            for h in hidden:
                if h["name"] == "switched_heat":
                    h["intervals_s"] = on_intervals(head, rows, one["columns"][0], one["on_share"])
                    if undescribed:
                        # A logged input drives the heat: by its column, not by intervals.
                        h["driver"] = one["columns"][0]
                        h["right"] = ["extra_heat_source", "switched_heat"]
                        h["half"] = ["standing_heat"]
        if not undescribed:
            head, rows = without(head, rows, one["columns"])
        write(folder / f"r{i + 1}.csv", head, rows)
    expected = {"case": name, "world": "withheld_input", "hidden": hidden, **one["expected"]}
    weak = expected.pop("weak", None)
    if weak:
        # Z moves with the bed, which nobody measured: "unexplained", or a poor stand-in that is not sure.
        half = [{"id": w, "max_confidence": 0.8} for w in weak]
        expected["hidden"].append({"name": "Z by the bed", "right": [], "half": half, "channel": "dZ_um"})
    (folder / "machine.json").write_text(json.dumps(machine, indent=1))
    (folder / "expected.json").write_text(json.dumps(expected, indent=1))
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    data = data_folder()
    if not data.is_dir():
        print(f"skipped: no recordings in {data} (set ZERODRIFT_DATA_DIR)")
        return 77
    made = 0
    for one in CASES:
        made += build(one, data, arguments.out, False)
        if one["sources"]:
            made += build(one, data, arguments.out, True)
    print(f"{made} cases in {arguments.out}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
