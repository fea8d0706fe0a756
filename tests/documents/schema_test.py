"""The schemas in resources/schema agree with the readers: what is shipped and shown validates, and a document whose form
the reader refuses is refused by its schema as well (and the other way round).

schema_test.py SOURCE_FOLDER BIN_FOLDER
"""

import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import jsonschema

root = pathlib.Path(sys.argv[1])
programs = pathlib.Path(sys.argv[2])
folder = root / "resources" / "schema"
faults = []

schemas = {name: json.loads((folder / f"{name}.schema.json").read_text()) for name in ("machine", "profile", "header-map")}
store = {f"{name}.schema.json": schema for name, schema in schemas.items()}


def validator(name):
    schema = schemas[name]
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema, resolver=jsonschema.RefResolver("", schema, store=store))


validators = {name: validator(name) for name in schemas}

# Every kind of part once, nothing that the reader takes from elsewhere in the document.
material = {"conductivity_W_mK": 45, "density_kg_m3": 7850, "heat_capacity_J_kgK": 460, "expansion_1_K": 1.15e-5}
machine = {
    "format": "zerodrift-machine/1",
    "name": "All of it",
    "initial_temperature_C": 20.0,
    "reference_temperature_C": 20.0,
    "input_timing_sigma_s": 1.0,
    "components": [
        {
            "id": "spindle", "length_mm": 400, "outer_diameter_mm": 100, "bore_diameter_mm": 30, "material": material,
            "prescribed": False,
            "heat_sources": [
                {"id": "motor", "kind": "motor", "from_mm": 60, "to_mm": 160, "rated_power_W": 5500, "efficiency": 0.9,
                 "rated_speed_rpm": 8000, "scale": 1.0,
                 "cooling_jacket": {"flow_L_min": 4, "channel_diameter_mm": 8, "channel_length_mm": 900, "area_mm2": 20000,
                                    "coolant_temperature_C": 20}},
                {"id": "bearing", "kind": "bearing", "from_mm": 330, "to_mm": 355, "mean_diameter_mm": 85, "f0": 2,
                 "f1": 0.001, "load_N": 900, "oil_viscosity_mm2_s": 32, "power_unknown": False},
                {"id": "heater", "kind": "input", "from_mm": 0, "to_mm": 5, "channel": "coolant_on", "watts_per_unit": 7.5},
                {"id": "slow", "kind": "input", "from_mm": 0, "to_mm": 5, "channel": "coolant_on", "power_unknown": True},
                {"id": "speed", "kind": "speed", "from_mm": 0, "to_mm": 5, "channel": "spindle_rpm", "law": ["on", "n"],
                 "law_watts": {"on": 3.0, "n": 1.0}, "full_speed_rpm": 6000},
                {"id": "nut", "kind": "nut", "from_mm": 0, "to_mm": 5, "channel": "spindle_rpm", "friction_N": 90},
                {"id": "guide", "kind": "guide", "from_mm": 0, "to_mm": 5, "channel": "spindle_rpm", "friction_N": 90}],
            "conduction_shares": [1.1, 0.9],
            "inner_body": {"section_share": 0.3, "coupling_W_mK": 20, "coupling_rise": 0.1, "growth_share": 0.3,
                           "shaft_in_cartridge": False, "heat_share": {"motor": 0.4}, "contact_W_K": {"motor": 9.0},
                           "near_field_K_W": {"T1_C": 0.01}, "near_lag_s": 60}},
        {"id": "housing", "kind": "lump", "heat_capacity_J_K": 9000, "area_mm2": 200000, "length_mm": 100,
         "material": {"expansion_1_K": 1.1e-5}, "heat_sources": [{"id": "pump", "kind": "input", "channel": "coolant_on",
                                                                  "watts_per_unit": 5}]}],
    "couplings": [{"between": [{"component": "spindle", "position_mm": 340}, {"component": "housing"}],
                   "conductance_W_K": 4.0}],
    "effects": ["convection"],
    "effect_parameters": {"convection": {"h_W_m2K": 12}},
    "tolerances": {"conductivity": 0.1, "heat_capacity": 0.1, "heat_source_power": 0.3, "film": 0.3, "expansion": 0.1,
                   "conductance": 0.3},
    "sensors": [{"channel": "T1_C", "component": "spindle", "position_mm": 345, "accuracy_C": 0.1, "lag_s": 5},
                {"channel": "ambient_C", "component": "ambient"}],
    "displacements": [{"channel": "dZ_um", "direction": "Z", "component": "spindle", "sign": 1, "accuracy_um": 3}],
    "room": {"channel": "ambient_C", "temperature_C": 20, "sigma_C": 0.7, "per_recording": True},
    "fluids": [{"id": "chiller", "temperature_channel": "T1_C", "flow_channel": "coolant_on", "always_on": True}],
}
tcp = {
    "format": "zerodrift-profile/1",
    "name": "All of it",
    "time_factor": 1,
    "controller": {"kind": "modbus-tcp", "host": "127.0.0.1", "port": 9, "unit": 1, "timeout_ms": 100,
                   "register_map": "zerodrift-virtual", "chunk_registers": 64},
    "cameras": [{"id": "front", "url": "http://127.0.0.1:9/front.mjpg", "axes": ["X", "Z"], "um_per_px_nominal": 12,
                 "target_roi_px": [240, 160, 160, 160], "reference_roi_px": [[39, 299, 120, 120]],
                 "pixel_size_known": True, "assumed_latency_s": 0.5},
                {"id": "side", "url": "aravis:DA1234567", "axes": ["Y", "Z"], "target_roi_px": [240, 160, 160, 160],
                 "exposure_us": 5000, "gain_db": 3}],
    "errors": {"source": "camera"},
    "measure_position_mm": {"X": 0, "Z": 1.5},
    "calibration_span_mm": 1.6,
    "sensors": [{"channel": "T1_C", "label": "Front", "place": "spindle", "position_mm": 345, "accuracy_C": 0.1}],
    "limits": {"max_um": 200, "max_um_per_s": 2, "max_drift_um_per_min": 50, "max_um_per_K": 100},
}
rtu = {"format": "zerodrift-profile/1",
       "controller": {"kind": "modbus-rtu", "device": "/dev/null", "baud": 19200, "parity": "E", "stop_bits": 1, "unit": 1}}
# A control, and every kind of device beside it.
rig = {
    "format": "zerodrift-profile/1",
    "controller": {"kind": "modbus-tcp", "host": "127.0.0.1", "port": 9},
    "devices": [
        {"id": "module", "kind": "modbus-rtu", "device": "/dev/null", "baud": 19200, "parity": "none", "stop_bits": 1,
         "unit": 3, "timeout_ms": 100, "register_map": "temperature-module-8-pt100", "poll_period_s": 1,
         "stale_after_s": 5},
        {"id": "amplifier", "kind": "modbus-tcp", "host": "127.0.0.1", "port": 10, "unit": 2,
         "register_map": "probe-amplifier"},
        {"id": "shop", "kind": "mqtt", "host": "127.0.0.1", "port": 9, "tls": True, "ca_file": "ca.pem",
         "credentials_file": "user.json", "timeout_ms": 100, "poll_period_s": 1, "stale_after_s": 60},
        {"id": "agent", "kind": "mtconnect", "url": "http://127.0.0.1:9/", "credentials_file": "user.json",
         "timeout_ms": 100, "poll_period_s": 1, "stale_after_s": 60}],
    "ambient": {"device": "shop", "signal": "shop/room#/temperature_C"},
    "speed": {"device": "agent", "signal": "S1speed"},
    "load": {"device": "agent", "signal": "S1load"},
    "coolant": {"device": "agent", "signal": "coolant"},
    "compensation_state": {"device": "agent", "signal": "switch"},
    "positions": {"X": {"device": "agent", "signal": "Xact"}},
    "probes": {"device": "amplifier", "signal": "probe_um"},
    "sensors": [{"channel": "T1_C", "device": "module", "signal": "temperature_C[1]"}, {"channel": "T2_C"}]}
# Probes one by one.
probes = {"format": "zerodrift-profile/1", "controller": {"kind": "manual"},
          "devices": [{"id": "agent", "kind": "mtconnect", "url": "http://127.0.0.1:9/"}],
          "probes": {"X1": {"device": "agent", "signal": "P1"}, "Z": {"device": "agent", "signal": "P3"}}}
# The control is one of the devices.
own_control = {"format": "zerodrift-profile/1", "control": "plc",
               "devices": [{"id": "plc", "kind": "modbus-tcp", "host": "127.0.0.1", "port": 9, "unit": 1},
                           {"id": "agent", "kind": "mtconnect", "url": "http://127.0.0.1:9/"}]}
# A control without a link, as `controller` and as one of the devices.
manual = {"format": "zerodrift-profile/1", "controller": {"kind": "manual", "serial": 4711},
          "devices": [{"id": "agent", "kind": "mtconnect", "url": "http://127.0.0.1:9/"}],
          "sensors": [{"channel": "T1_C", "device": "agent", "signal": "T1"}]}
manual_device = {"format": "zerodrift-profile/1", "devices": [{"id": "person", "kind": "manual", "serial": 4711}]}
header_map = {
    "columns": {"Lager vorn (°C)": {"channel": "T1_C", "unit": "degC", "offset": 0.1, "location": "front bearing"},
                "Taster Z [mm]": {"channel": "probe_um", "scale": 1000, "axis": "Z"}, "Bemerkung": None},
    "time": {"unit": "s"},
    "decimal": ".", "separator": ",", "encoding": "UTF-8", "missing": ["DEFECT"]}

# What the reader knows only with the rest of the document: which effect takes which parameters, which place is on a rod.
elsewhere = {("components",), ("effect_parameters",), ("effect_parameters", "convection"),
             ("effect_parameters", "convection", "h_W_m2K"), ("sensors", 0, "position_mm"),
             ("couplings", 0, "between", 0, "position_mm")}
# And which device a signal is of.
elsewhere |= {("devices",)}


readers = subprocess.Popen([programs / "document_readers"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def refused(name, document):
    """By the reader: the sentence names the file and the key."""
    readers.stdin.write(json.dumps({"kind": name, "document": document}) + "\n")
    readers.stdin.flush()
    answer = readers.stdout.readline()
    assert answer, f"the reader of a {name} ended at {json.dumps(document)}"
    return answer.strip() if re.search(r'document\.json: "(.+?)" is ', answer) else ""


def changes(value, path=()):
    """Every value gone, or of another form: (path, document with that change)."""
    wrong = [-1e9, 1e12] if isinstance(value, (int, float)) and not isinstance(value, bool) else [7]
    if path:
        for other in wrong:
            yield path, other
    if isinstance(value, dict):
        for key, one in value.items():
            yield path + (key,), changes
            yield from changes(one, path + (key,))
    if isinstance(value, list):
        for place, one in enumerate(value):
            yield from changes(one, path + (place,))


def changed(document, path, value):
    out = copy.deepcopy(document)
    at = out
    for key in path[:-1]:
        at = at[key]
    if value is changes:
        del at[path[-1]]
    else:
        at[path[-1]] = value
    return out


def compare(name, document):
    if sentence := refused(name, document):
        return faults.append(f"{name}: the reader refuses the document of this test: {sentence}")
    count = 0
    for path, value in changes(document):
        if path in elsewhere:
            continue
        other = changed(document, path, value)
        by_reader = refused(name, other)
        by_schema = next((error.message for error in validators[name].iter_errors(other)), "")
        what = "taken away" if value is changes else json.dumps(value)
        if bool(by_reader) != bool(by_schema):
            faults.append(f"{name}, {'.'.join(map(str, path))} {what}: the reader says {by_reader or 'nothing'!r}, the "
                          f"schema {by_schema or 'nothing'!r}")
        count += bool(by_reader)
    print(f"{name}: {count} documents are refused by both")


def check(name, document, where):
    for error in validators[name].iter_errors(document):
        faults.append(f"{where}: {'/'.join(map(str, error.absolute_path))}: {error.message}")


check("machine", machine, "this test")
check("machine", json.loads((root / "examples" / "machine.json").read_text()), "examples/machine.json")
check("header-map", json.loads((root / "examples" / "names.json").read_text()), "examples/names.json")
for path in [*sorted((root / "examples").glob("*profile.json")), *sorted((root / "resources" / "profiles").glob("*.json"))]:
    document = json.loads(path.read_text())
    check("profile", document, path.name)
    if isinstance(document.get("machine"), dict):
        check("machine", document["machine"], f"{path.name}, machine")
shown = 0
for path in sorted((root / "docs").rglob("*.md")):
    for block in re.findall(r"```json\n(.*?)```", path.read_text(), re.S):
        try:
            document = json.loads(block)
        except json.JSONDecodeError:
            continue  # a part of one, with dots
        kind = {"zerodrift-machine/1": "machine", "zerodrift-profile/1": "profile"}.get(document.get("format", ""))
        kind = kind or ("header-map" if "columns" in document else None)
        if kind:
            shown += 1
            check(kind, document, path.relative_to(root))
        if kind == "profile" and (sentence := refused("profile", document)):
            faults.append(f"{path.relative_to(root)}: the reader refuses the example: {sentence}")
print(f"{shown} documents in docs/ are valid")
if shown < 5:
    faults.append("docs/ show no machine description, header map or profile of a rig any more")

with tempfile.TemporaryDirectory() as scratch:
    for part in ("--rig", "--manual"):
        path = pathlib.Path(scratch) / f"profile{part}.json"
        machine_tool = subprocess.Popen(
            [programs / "zerodrift-machine", "--port", "0", "--camera-port", "0", part, "--mqtt-broker", "127.0.0.1:9",
             "--profile", path], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        machine_tool.stdout.readline()
        machine_tool.terminate()
        machine_tool.wait(20)
        document = json.loads(path.read_text())
        check("profile", document, f"zerodrift-machine {part}")
        if sentence := refused("profile", document):
            faults.append(f"zerodrift-machine {part}: the reader refuses its profile: {sentence}")


def keys_of(schema):
    """Names of all properties of a schema."""
    if isinstance(schema, list):
        return set().union(*map(keys_of, schema)) if schema else set()
    if not isinstance(schema, dict):
        return set()
    return set(schema.get("properties", {})).union(*map(keys_of, schema.values()))


reference = "".join((root / "docs" / page).read_text() for page in ("profile.md", "reference/devices.md"))
for key in sorted(keys_of(schemas["profile"])):
    if not re.search(rf"`[^`\n]*\b{key}\b[^`\n]*`", reference):
        faults.append(f"docs/profile.md and docs/reference/devices.md do not explain the key {key}")

compare("machine", machine)
for profile in (tcp, rtu, rig, own_control, probes, manual, manual_device):
    compare("profile", profile)
compare("header-map", header_map)
listed = refused("machine", changed(machine, ("effects",), ["none"])).split("one of ")[1].split(". ")[0].split(", ")
if set(listed) != set(schemas["machine"]["properties"]["effects"]["items"]["enum"]):
    faults.append(f"the effects of the reader are {', '.join(listed)}; the schema lists others")

readers.stdin.close()
readers.wait(20)
print("\n".join(faults))
sys.exit(1 if faults else 0)
