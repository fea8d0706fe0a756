"""A register map made from a list such as a PLC's project gives connects the virtual machine: the same temperatures as
through the shipped map, every register decoded, and what the list lacks is told.

Usage: map_test.py"""

import json
import os

from virtual_machine import VirtualMachine, cli, run_in_folder, write_json


def test(folder):
    listed = os.path.join(folder, "plc.csv")
    with open(listed, "w") as file:
        file.write("Tag;Number;Datatype;Factor;Function\n")
        for i in range(20):
            file.write(f"temperature_C[{i + 1}];{40101 + i};INT;0.0625;\n")
        file.write("ambient_C;40097;INT;0.0625;\nstate;40017;WORD;;\ncompensation_state;40018;WORD;;\n"
                   "clock_s;40009;DWORD;0.01;\nM7;40031;REAL;;\n")
    with VirtualMachine(folder, 1, 4) as machine:
        made = os.path.join(folder, "plc.json")
        _, out, err = cli("machine", "map", "--list", listed, "--out", made, "--json")
        result = json.loads(out)
        assert result["registers"] == 6, result
        assert result["missing"]["temperatures"] == [] and "table_commit" in result["missing"]["table"]
        assert "M7" in err, err
        with open(machine.profile) as file:
            profile = json.load(file)
        profile["controller"]["register_map"] = "plc.json"
        own = write_json(os.path.join(folder, "own.json"), profile)
        _, out, _ = cli("machine", "check", "--profile", own, "--json")
        through_own = json.loads(out)
        _, out, _ = cli("machine", "check", "--profile", machine.profile, "--json")
        shipped = json.loads(out)
        for a, b in zip(through_own["sensors"], shipped["sensors"]):
            assert a["ok"] == b["ok"]
            assert not a["ok"] or abs(a["temperature_C"] - b["temperature_C"]) < 2.0, (a, b)
        assert not through_own["accepts_table"]
        _, out, _ = cli("machine", "registers", "--profile", machine.profile, "--json")
        rows = json.loads(out)["registers"]
        assert len(rows) > 50 and all("error" not in row for row in rows), rows
        _, out, _ = cli("machine", "registers", "--profile", machine.profile, "--map", listed)
        assert "M7" in out and "no use known" in out, out


run_in_folder(test)
