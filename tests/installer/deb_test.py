"""Makes the Debian package of a build and looks into it: what it holds, what it needs, and what the tools that judge
such files say of it.

Usage: deb_test.py BUILD_FOLDER PROGRAM_FOLDER CPACK"""

import gzip
import os
import re
import shutil
import subprocess
import sys
import tempfile

BUILD, BIN, CPACK = sys.argv[1:4]
MOST_BYTES = 12_000_000

FILES = """
usr/bin/zerodrift
usr/bin/zerodrift-cli
usr/bin/zerodrift-machine
usr/lib/systemd/system/zerodrift-compensate@.service
usr/lib/udev/rules.d/70-zerodrift-rs485.rules
usr/share/applications/org.zerodrift.Zerodrift.desktop
usr/share/doc/zerodrift/changelog.gz
usr/share/doc/zerodrift/compensator.md
usr/share/doc/zerodrift/copyright
usr/share/doc/zerodrift/licences.md
usr/share/icons/hicolor/scalable/apps/org.zerodrift.Zerodrift.svg
usr/share/icons/hicolor/scalable/mimetypes/application-x-zerodrift-job.svg
usr/share/man/man1/zerodrift.1.gz
usr/share/man/man1/zerodrift-cli.1.gz
usr/share/man/man1/zerodrift-machine.1.gz
usr/share/metainfo/org.zerodrift.Zerodrift.metainfo.xml
usr/share/mime/packages/org.zerodrift.Zerodrift.xml
usr/share/zerodrift/resources/profiles/virtual-five-axis.json
usr/share/zerodrift/resources/register_maps/probe-amplifier.json
usr/share/zerodrift/resources/register_maps/temperature-module-8-ds18b20.json
usr/share/zerodrift/resources/register_maps/temperature-module-8-pt100.json
usr/share/zerodrift/resources/register_maps/virtual-rig-control.json
usr/share/zerodrift/resources/register_maps/zerodrift-virtual.json
usr/share/zerodrift/resources/samples/sample.zdj
""".split()


def run(*command, **options):
    done = subprocess.run(command, capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(command)}: exit {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


def make(folder):
    run(CPACK, "-G", "DEB", "-B", folder, cwd=BUILD)
    packages = [name for name in os.listdir(folder) if name.endswith(".deb")]
    assert len(packages) == 1, packages
    return os.path.join(folder, packages[0])


def look_at_list(package):
    held = set()
    for line in run("dpkg-deb", "-c", package).splitlines():
        mode, owner, _, _, _, name = line.split(maxsplit=5)
        assert owner == "root/root", line
        assert mode[5] == "-" and mode[8] == "-", f"others may write: {line}"
        held.add(name[2:].rstrip("/"))
    missing = [name for name in FILES if name not in held]
    assert not missing, missing
    for name in held:
        assert name == "usr" or name.startswith(("usr/bin", "usr/lib", "usr/share")), name
        assert not name.endswith((".a", ".h", "-wal", "-shm")), name
    assert os.path.getsize(package) < MOST_BYTES, os.path.getsize(package)


def look_at_control(package):
    depends = run("dpkg-deb", "-f", package, "Depends")
    for library in ("libqt6widgets6", "libopencv-core406", "libmodbus5", "libsqlite3-0"):
        assert library in depends, depends
    for useless in ("-dev", "qt5", "libopencv-highgui", "libgtest"):
        assert useless not in depends, depends


def look_at_papers(root):
    share = os.path.join(root, "usr/share")
    if shutil.which("desktop-file-validate"):
        run("desktop-file-validate", f"{share}/applications/org.zerodrift.Zerodrift.desktop")
    if shutil.which("appstreamcli"):
        run("appstreamcli", "validate", "--no-net", f"{share}/metainfo/org.zerodrift.Zerodrift.metainfo.xml")
    if shutil.which("update-mime-database"):
        run("update-mime-database", f"{share}/mime")
        with open(f"{share}/mime/globs2") as file:
            assert "application/x-zerodrift-job:*.zdj" in file.read()
    if shutil.which("systemd-analyze"):
        unit = os.path.join(root, "usr/lib/systemd/system/zerodrift-compensate@.service")
        said = subprocess.run(["systemd-analyze", "verify", unit], capture_output=True, text=True).stderr
        # Program and manual page are not installed here; anything else is a mistake in the file.
        odd = [line for line in said.splitlines() if "zerodrift-compensate" in line
               and "not executable" not in line and "Command 'man" not in line]
        assert not odd, odd


def options_of(program, *command):
    return re.findall(r"^  (?:-\w,)?(--[\w-]+)", run(os.path.join(BIN, program), *command, "--help"), re.M)


def commands_of(program):
    """Subcommands as they are called; those of "machine" with their second word."""
    def below(*words):
        text = run(os.path.join(BIN, program), *words, "--help").split("Subcommands:")
        return re.findall(r"^  ([a-z-]+)(?: {2,}|$)", text[1], re.M) if len(text) > 1 else []
    all_commands = []
    for first in below():
        all_commands += [f"{first} {second}" for second in below(first)] or [first]
    return all_commands


def look_at_manual(root):
    """Every command and every option stands in the manual page."""
    for program in ("zerodrift", "zerodrift-cli", "zerodrift-machine"):
        with gzip.open(os.path.join(root, f"usr/share/man/man1/{program}.1.gz"), "rt") as file:
            text = file.read().replace("\\-", "-")
        missing = [option for option in options_of(program) if option not in text]
        if program == "zerodrift-cli":
            sections = {part.split("\n", 1)[0]: part for part in text.split(".SS ")[1:]}
            for command in commands_of(program):
                missing += [f"{command} {option}" for option in options_of(program, *command.split())
                            if option not in sections.get(command, "") and option not in ("--help", "--json")]
        assert not missing, (program, missing)


def ask_lintian(package):
    if not shutil.which("lintian"):
        return "lintian is not there"
    said = subprocess.run(["lintian", "--fail-on", "error", package], capture_output=True, text=True)
    assert said.returncode == 0, said.stdout + said.stderr
    return "lintian: " + (said.stdout.strip() or "nothing to say")


for tool in ("dpkg-deb", "dpkg-shlibdeps"):
    if not shutil.which(tool):
        print(f"{tool} is not there")
        sys.exit(77)
with tempfile.TemporaryDirectory() as folder:
    package = make(folder)
    look_at_list(package)
    look_at_control(package)
    root = os.path.join(folder, "root")
    run("dpkg-deb", "-x", package, root)
    look_at_papers(root)
    look_at_manual(root)
    # The programs find their files where they are installed.
    run(os.path.join(root, "usr/bin/zerodrift-cli"), "report", "--job",
        shutil.copy(os.path.join(root, "usr/share/zerodrift/resources/samples/sample.zdj"), folder),
        "--out", os.path.join(folder, "report.csv"))
    print(f"{os.path.basename(package)}: {os.path.getsize(package)} bytes; {ask_lintian(package)}")
