"""The examples of docs/reference/import.md give what stands there, workbooks written by openpyxl are read, and the commands that take
a recording take the same files with the same header map.

Usage: import_test.py"""

import csv
import datetime
import json
import os
import re
import subprocess

import openpyxl

from virtual_machine import BIN, run_in_folder

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")


def cli(folder, *arguments, code=0):
    done = subprocess.run([os.path.join(BIN, "zerodrift-cli"), *arguments], cwd=folder, capture_output=True, text=True,
                          timeout=120)
    assert done.returncode == code, (arguments, done.returncode, done.stdout, done.stderr)
    return done


def examples(folder):
    with open(os.path.join(ROOT, "docs/reference/import.md"), encoding="utf-8") as file:
        blocks = re.findall(r"^```(\w+)(?: (\S+))?\n(.*?)^```$", file.read(), re.M | re.S)
    commands = 0
    for kind, name, text in blocks:
        if name.startswith("expected:"):
            with open(os.path.join(folder, name[len("expected:"):]), encoding="utf-8") as file:
                assert file.read() == text, (name, text)
        elif name:
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        elif kind == "console":
            command, *lines = text.strip("\n").split("\n")
            assert command.startswith("$ zerodrift-cli "), command
            done = subprocess.run([os.path.join(BIN, "zerodrift-cli"), *command.split()[2:]], cwd=folder,
                                  capture_output=True, text=True, timeout=120)
            said = (done.stdout + done.stderr).split("\n")
            for line in lines:
                assert line in said, (command, line, said)
            commands += 1
    assert commands >= 4, commands


def rows_of(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def workbooks(folder):
    book = openpyxl.Workbook()
    sheet = book.active
    sheet.title = "Messung"
    sheet.append(["Prüfstand 3"])
    sheet.append([])
    sheet.append(["Zeit", "Lager (°C)", "dZ_mm", "coolant_on", "Bemerkung"])
    start = datetime.datetime(2025, 11, 3, 7, 12, 40)
    for k in range(30):
        sheet.append([start + datetime.timedelta(seconds=20 * k), 20 + 0.25 * k, "#N/A" if k == 4 else 0.001 * k, k > 10,
                      "Start" if k == 0 else None])
    other = book.create_sheet("Other")
    other.append(["time_s", "T1_C"])
    for k in range(5):
        other.append([10 * k, 20.5 + k])
    path = os.path.join(folder, "run.xlsx")
    book.save(path)
    said = json.loads(cli(folder, "import", path, "--out", "x.csv", "--json").stdout)
    assert said["encoding"] == "xlsx" and said["sheet"] == "Messung", said
    assert said["time"]["start"] == "2025-11-03T07:12:40", said["time"]
    assert said["missing"] == {"#N/A": 1}, said["missing"]
    assert {fate["name"]: fate["fate"] for fate in said["columns"]}["Bemerkung"] == "words"
    rows = rows_of(os.path.join(folder, "x.csv"))
    assert len(rows) == 30
    for k, row in enumerate(rows):
        assert abs(float(row["time_s"]) - 20 * k) < 1e-3, row
        assert abs(float(row["Lager_C"]) - (20 + 0.25 * k)) < 1e-9, row
        assert row["dZ_um"] == "" if k == 4 else abs(float(row["dZ_um"]) - k) < 1e-9, row
        assert row["coolant_on"] == str(int(k > 10)), row
    cli(folder, "import", path, "--sheet", "Other", "--out", "x.csv")
    assert [row["T1_C"] for row in rows_of(os.path.join(folder, "x.csv"))] == ["20.5", "21.5", "22.5", "23.5", "24.5"]
    assert "Messung, Other" in cli(folder, "import", path, "--sheet", "No", "--out", "x.csv", code=1).stderr
    apart = openpyxl.Workbook()
    apart.active.append(["Date", "Time", "T1_C"])
    for k in range(4):
        at = datetime.datetime(2025, 11, 3, 23, 59, 30) + datetime.timedelta(seconds=20 * k)
        apart.active.append([at.date(), at.time(), 20 + k])
    apart.save(os.path.join(folder, "apart.xlsx"))
    cli(folder, "import", "apart.xlsx", "--out", "x.csv")
    assert [float(row["time_s"]) for row in rows_of(os.path.join(folder, "x.csv"))] == [0, 20, 40, 60]
    sheet["B5"] = "=B6+1"  # openpyxl computes nothing
    book.save(path)
    assert "row 5" in cli(folder, "import", path, "--out", "x.csv", code=1).stderr


def commands_take_the_same_files(folder):
    with open(os.path.join(folder, "shop.csv"), "w", encoding="utf-16") as file:
        file.write("Time (min)\tFront (degF)\tRear (degF)\tCH5\r\n")
        for k in range(200):
            file.write(f"{k}\t{68 + 0.09 * k:.3f}\t{68 + 0.05 * (k % 50):.3f}\t{0.0001 * k:.5f}\r\n")
    with open(os.path.join(folder, "shop.json"), "w", encoding="utf-8") as file:
        json.dump({"columns": {"CH5": {"channel": "dZ_um", "unit": "mm"}}}, file)
    fit = json.loads(cli(folder, "fit", "--recording", "shop.csv", "--map", "shop.json", "--method", "mlr", "--sensors",
                         "Front_C", "--out", "model.json", "--json").stdout)
    assert fit["errors"][0]["error"] == "dZ_um", fit["errors"]
    cli(folder, "cluster", "--recording", "shop.csv", "--map", "shop.json", "--clusters", "2", "--out", "clusters.json")
    done = cli(folder, "predict", "--model", "model.json", "--recording", "shop.csv", "--map", "shop.json", "--out", "p.csv")
    assert "degF" in done.stderr, done.stderr


def job_from_files_only(folder):
    """Errors of any name are fitted, and a run without errors is explained, without a machine."""
    with open(os.path.join(folder, "probe.csv"), "w", encoding="utf-8") as file:
        file.write("Time (min);Front (°C);Rear (°C);Probe 1 (µm)\n")
        for k in range(240):
            warm = 8 * (1 - 0.985 ** k)
            file.write(f"{k};{20 + warm + 0.02 * (k % 3):.2f};{20 + 0.3 * warm + 0.02 * (k % 2):.2f};"
                       f"{2.5 * warm + 0.1 * (k % 5):.2f}\n".replace(".", ","))
    job = os.path.join(folder, "probe.zdj")
    cli(folder, "import", "probe.csv", "--job", job)
    cli(folder, "cluster", "--job", job, "--clusters", "2", "--out", "clusters.json")
    fit = json.loads(cli(folder, "fit", "--job", job, "--out", "model.json", "--json").stdout)
    assert [error["error"] for error in fit["errors"]] == ["Probe_1_um"], fit["errors"]
    cli(folder, "report", "--job", job, "--out", "probe.html")
    with open(os.path.join(folder, "probe.html"), encoding="utf-8") as file:
        assert "Front_C" in file.read()
    with open(os.path.join(folder, "rod.csv"), "w", encoding="utf-8") as file:
        file.write("time_s,heater_on,T1_C,T2_C,room_C\n")
        for k in range(200):
            file.write(f"{10 * k},{int(k < 100)},{20 + 0.05 * min(k, 100)},{20 + 0.02 * k},20\n")
    with open(os.path.join(folder, "rod.json"), "w", encoding="utf-8") as file:
        json.dump({"format": "zerodrift-machine/1", "name": "rod", "components": [
            {"id": "rod", "length_mm": 300, "outer_diameter_mm": 20, "bore_diameter_mm": 0,
             "material": {"conductivity_W_mK": 200, "density_kg_m3": 2700, "heat_capacity_J_kgK": 900,
                          "expansion_1_K": 2.3e-5},
             "heat_sources": [{"id": "heater", "kind": "input", "channel": "heater_on", "from_mm": 0, "to_mm": 5,
                               "watts_per_unit": 2}]}],
            "sensors": [{"channel": "T1_C", "component": "rod", "position_mm": 20, "accuracy_C": 0.1},
                        {"channel": "T2_C", "component": "rod", "position_mm": 280, "accuracy_C": 0.1}]}, file)
    heat = os.path.join(folder, "rod.zdj")
    cli(folder, "import", "rod.csv", "--job", heat)
    found = json.loads(cli(folder, "diagnose", "--job", heat, "--machine", "rod.json", "--out", "d.json", "--json").stdout)
    assert found["verdict"] in ("consistent", "missing_effect", "unexplained"), found
    cli(folder, "report", "--job", heat, "--out", "rod.html")


def usage(folder):
    for arguments in (["import", "logger.csv"], ["import", "logger.csv", "--out", "r.csv", "--job", "r.zdj"],
                      ["cluster", "--out", "c.json"], ["fit", "--recording", "r.csv", "--job", "r.zdj", "--out", "m.json"]):
        cli(folder, *arguments, code=2)
    assert cli(folder, "import", "logger.csv", "--out", "logger.csv", code=2).stderr


def check(folder):
    examples(folder)
    usage(folder)
    workbooks(folder)
    commands_take_the_same_files(folder)
    job_from_files_only(folder)


run_in_folder(check)
