"""Meshes a structure with gmsh, assembles it with FreeFEM and keeps the matrices of a reduced model.

The reduced model is a rational Krylov space: the answers of the full model to every source, surface and interface at
several rates. It is made once for each structure and stored in the folder given.
"""

import os
import pathlib
import subprocess
import sys

import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg as sparse_linalg

from structures import STRUCTURES

# Where Debian keeps the plug-ins of FreeFEM.
ENVIRONMENT = dict(os.environ, FF_LOADPATH="/usr/lib/freefem++", FF_INCLUDEPATH="/usr/lib/freefem++")
SHIFTS_1_S = (1 / 20000.0, 1 / 3000.0, 1 / 500.0, 1 / 80.0)
KEPT = 3e-5  # singular values of the scaled answers, relative
FILM_W_M2K = 10.0  # of the model that the space is made with


def run(command, folder):
    with open(folder / "log.txt", "a") as log:
        log.write(" ".join(map(str, command)) + "\n")
        log.flush()
        subprocess.run([str(word) for word in command], check=True, stdout=log, stderr=subprocess.STDOUT, env=ENVIRONMENT, cwd=folder)


def read_msh(path):
    """Nodes in mm and tetrahedra with the tag of their volume, from gmsh's format 2.2."""
    lines = path.read_text().split("\n")
    start = lines.index("$Nodes") + 1
    count = int(lines[start])
    nodes = {}
    for line in lines[start + 1 : start + 1 + count]:
        words = line.split()
        nodes[int(words[0])] = tuple(map(float, words[1:4]))
    start = lines.index("$Elements") + 1
    tetrahedra, tags = [], []
    for line in lines[start + 1 : start + 1 + int(lines[start])]:
        words = list(map(int, line.split()))
        if words[1] != 4:
            continue
        tags.append(words[4])
        tetrahedra.append(words[3 + words[2] :])
    tetrahedra = np.array(tetrahedra)
    used = np.unique(tetrahedra)
    renumber = np.zeros(max(nodes) + 1, dtype=int)
    renumber[used] = np.arange(len(used))
    return np.array([nodes[i] for i in used]), renumber[tetrahedra], np.array(tags)


FACES = ((1, 2, 3), (0, 2, 3), (0, 1, 3), (0, 1, 2))


def faces_of(tetrahedra, part):
    """Outer triangles and those between two parts: (nodes, part, other part or -1)."""
    seen = {}
    for row, tetrahedron in enumerate(tetrahedra):
        for face in FACES:
            seen.setdefault(tuple(sorted(tetrahedron[list(face)])), []).append(part[row])
    outer, between = [], []
    for face, parts in seen.items():
        if len(parts) == 1:
            outer.append((face, parts[0], -1))
        elif parts[0] != parts[1]:
            a, b = sorted(parts)
            between.append((face, a, b))
    return outer, between


def write_mesh(path, points, tetrahedra, regions, triangles, labels):
    with open(path, "w") as file:
        file.write("MeshVersionFormatted 2\nDimension 3\n")
        file.write(f"Vertices\n{len(points)}\n")
        for p in points:
            file.write(f"{p[0]:.9g} {p[1]:.9g} {p[2]:.9g} 0\n")
        file.write(f"Tetrahedra\n{len(tetrahedra)}\n")
        for t, region in zip(tetrahedra, regions):
            file.write(f"{t[0] + 1} {t[1] + 1} {t[2] + 1} {t[3] + 1} {region}\n")
        file.write(f"Triangles\n{len(triangles)}\n")
        for t, label in zip(triangles, labels):
            file.write(f"{t[0] + 1} {t[1] + 1} {t[2] + 1} {label}\n")
        file.write("End\n")


def read_matrix(path, size):
    """A matrix as FreeFEM prints it: comment lines, a line of counts, then row, column, value."""
    with open(path) as file:
        skip = 0
        for line in file:
            skip += 1
            if not line.startswith("#"):
                break
    counts = line.split()
    entries = np.loadtxt(path, skiprows=skip, ndmin=2)
    if len(entries) == 0:
        return sparse.csr_matrix((size, size))
    entries = entries[entries[:, 2] != 0.0]
    rows, columns = entries[:, 0].astype(int), entries[:, 1].astype(int)
    matrix = sparse.coo_matrix((entries[:, 2], (rows, columns)), shape=(size, size)).tocsr()
    if counts[3] != "0":  # only one half is stored
        matrix = matrix + sparse.triu(matrix.T, 1) + sparse.tril(matrix.T, -1)
    return matrix


class Solid:
    """The full model of a structure: nodes in mm, matrices of each part, surface and interface."""

    def __init__(self, structure, folder):
        self.structure = structure
        self.names = [part.name for part in structure.parts]
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "structure.geo").write_text(structure.geo)
        run(["gmsh", "-3", "-format", "msh22", "-o", "structure.msh", "structure.geo"], folder)
        points, tetrahedra, tags = read_msh(folder / "structure.msh")
        part_of_tag = {tag: i for i, part in enumerate(structure.parts) for tag in part.volumes}
        unknown = set(tags) - set(part_of_tag)
        if unknown:
            raise SystemExit(f"{structure.name}: gmsh made volumes {sorted(unknown)} that no part has")
        part = np.array([part_of_tag[tag] for tag in tags])
        self._split(points, tetrahedra, part)
        self._label(points, tetrahedra, part)
        write_mesh(
            folder / "thermal.mesh", self.points / 1000, self.tetrahedra, part + 1, self.triangles, self.labels
        )
        self._write_elastic(points, tetrahedra, part, folder)
        run(["FreeFem++-nw", "-v", "1", pathlib.Path(__file__).resolve().parent / "assemble.edp"], folder)
        self._read(folder)

    def _split(self, points, tetrahedra, part):
        """A node of its own for each part that a mesh node belongs to."""
        self.of_part = {}
        self.points = []
        self.merged = []
        self.tetrahedra = np.empty_like(tetrahedra)
        for row, tetrahedron in enumerate(tetrahedra):
            for k, node in enumerate(tetrahedron):
                key = (part[row], node)
                if key not in self.of_part:
                    self.of_part[key] = len(self.points)
                    self.points.append(points[node])
                    self.merged.append(node)
                self.tetrahedra[row, k] = self.of_part[key]
        self.points = np.array(self.points)
        self.merged = np.array(self.merged)
        self.part_of_node = np.empty(len(self.points), dtype=int)
        for (which, _), node in self.of_part.items():
            self.part_of_node[node] = which

    def _label(self, points, tetrahedra, part):
        outer, between = faces_of(tetrahedra, part)
        self.surface_names = list(self.names) + list(self.structure.surfaces)
        self.interfaces = []
        self.triangles, self.labels = [], []
        for face, which, _ in outer:
            centre = points[list(face)].mean(axis=0)
            label = which
            for i, (owner, test) in enumerate(self.structure.surfaces.values()):
                if owner == self.names[which] and test(*centre):
                    label = len(self.names) + i
                    break
            self.triangles.append([self.of_part[which, node] for node in face])
            self.labels.append(label + 1)
        for face, a, b in between:
            pair = (self.names[a], self.names[b])
            if pair not in self.interfaces:
                self.interfaces.append(pair)
            self.triangles.append([self.of_part[a, node] for node in face])
            self.labels.append(len(self.surface_names) + self.interfaces.index(pair) + 1)
        self.triangles = np.array(self.triangles)
        self.labels = np.array(self.labels)

    def _write_elastic(self, points, tetrahedra, part, folder):
        elastic = np.array([p.elastic for p in self.structure.parts])[part]
        used = np.unique(tetrahedra[elastic])
        number = -np.ones(len(points), dtype=int)
        number[used] = np.arange(len(used))
        outer, _ = faces_of(tetrahedra[elastic], part[elastic])
        triangles = [[number[node] for node in face] for face, _, _ in outer]
        fixed = self.structure.fixed
        labels = [999 if all(fixed(*points[node]) for node in face) else 1 for face, _, _ in outer]
        write_mesh(
            folder / "elastic.mesh", points[used] / 1000, number[tetrahedra[elastic]], part[elastic] + 1, triangles, labels
        )
        self.elastic_number = number
        with open(folder / "plan.txt", "w") as file:
            count = len(self.surface_names) + len(self.interfaces)
            file.write(f"{len(self.names)} {count} {len(self.structure.displacements)}\n")
            for p in self.structure.parts:
                file.write(f"{p.material['E']} {p.material['nu']} {p.material['alpha']}\n")
            for direction, _, _ in self.structure.displacements.values():
                file.write(f"{direction}\n")
        for i, (_, moving, reference) in enumerate(self.structure.displacements.values()):
            force = np.zeros(len(used))
            for sign, test in ((1.0, moving), (-1.0, reference)):
                if test is None:
                    continue
                area = self._areas(points, outer, number, len(used), test)
                if area.sum() <= 0:
                    raise SystemExit(f"{self.structure.name}: no surface moves for displacement {i}")
                force += sign * area / area.sum()
            np.savetxt(folder / f"force{i}.txt", force)

    def _areas(self, points, outer, number, count, test):
        """Area of the outer triangles that pass the test, a third to each node; the nodes themselves where none is."""
        area = np.zeros(count)
        for face, _, _ in outer:
            corners = points[list(face)]
            if all(test(*corner) for corner in corners):
                size = 0.5 * np.linalg.norm(np.cross(corners[1] - corners[0], corners[2] - corners[0]))
                for node in face:
                    area[number[node]] += size / 3
        if area.sum() == 0:
            for node in np.flatnonzero(number >= 0):
                if test(*points[node]):
                    area[number[node]] = 1.0
        return area

    def _read(self, folder):
        size = len(self.points)
        self.K = [read_matrix(folder / f"K{i + 1}.txt", size) for i in range(len(self.names))]
        self.M = [read_matrix(folder / f"M{i + 1}.txt", size) for i in range(len(self.names))]
        count = len(self.surface_names)
        self.F = [read_matrix(folder / f"F{i + 1}.txt", size) for i in range(count)]
        self.C = []
        for i, (a, b) in enumerate(self.interfaces):
            film = read_matrix(folder / f"F{count + i + 1}.txt", size).tocoo()
            other = self.names.index(b)
            partner = np.array([self.of_part.get((other, node), -1) for node in self.merged])
            rows, columns, values = [], [], []
            for r, c, v in zip(film.row, film.col, film.data):
                rr, cc = partner[r], partner[c]
                rows += [r, rr, r, rr]
                columns += [c, cc, cc, c]
                values += [v, v, -v, -v]
            self.C.append(sparse.coo_matrix((values, (rows, columns)), shape=(size, size)).tocsr())
        self.g = {}
        for i, channel in enumerate(self.structure.displacements):
            total = np.zeros((len(self.names), size))
            for p in range(len(self.names)):
                if not self.structure.parts[p].elastic:
                    continue
                gain = np.loadtxt(folder / f"g{i}_{p + 1}.txt")
                mine = self.part_of_node == p
                total[p, mine] = gain[self.elastic_number[self.merged[mine]]]
            self.g[channel] = total

    def nominal(self):
        """Conduction and storage of the parts as designed, films and contacts included."""
        parts = self.structure.parts
        A = sum(k * part.material["k"] for k, part in zip(self.K, parts))
        M = sum(m * part.material["rho"] * part.material["c"] for m, part in zip(self.M, parts))
        A = A + FILM_W_M2K * sum(self.F)
        for pair, contact in zip(self.interfaces, self.C):
            A = A + self.contact_of(pair) * contact
        return A.tocsc(), M.tocsc()

    def contact_of(self, pair):
        contacts = self.structure.contacts
        return contacts.get(pair, contacts.get(pair[::-1], 1e5))

    def volume_load(self, part, weight):
        """1 W spread over a part as weight(x, y, z) says; zero load where the weight is."""
        i = self.names.index(part)
        values = np.array([weight(*p) for p in self.points])
        load = self.M[i] @ values
        return load / load.sum()

    def surface_load(self, surface, weight=lambda x, y, z: 1.0):
        i = self.surface_names.index(surface)
        load = self.F[i] @ np.array([weight(*p) for p in self.points])
        return load / load.sum()

    def interface_load(self, pair, weight=lambda x, y, z: 1.0):
        """1 W that arises in an interface, half into each side."""
        contact = abs(self.C[self.interfaces.index(pair)])
        load = contact @ np.array([weight(*p) for p in self.points])
        return load / load.sum()

    def reading(self, point, parts=None):
        """What a sensor on the surface nearest to this point reads, as weights of the nodes."""
        best, row = np.inf, None
        for triangle, label in zip(self.triangles, self.labels):
            if label > len(self.surface_names):
                continue
            if parts and self.names[self.part_of_node[triangle[0]]] not in parts:
                continue
            weights, distance = closest(self.points[triangle], np.asarray(point, float))
            if distance < best:
                best, row = distance, (triangle, weights)
        reading = np.zeros(len(self.points))
        reading[row[0]] = row[1]
        return reading


def closest(corners, point):
    """Barycentric weights of the point of a triangle that is closest, and its distance."""
    a, b, c = corners
    normal = np.cross(b - a, c - a)
    u = np.linalg.lstsq(np.stack([b - a, c - a], axis=1), point - a, rcond=None)[0]
    if min(u[0], u[1], 1 - u[0] - u[1]) >= 0:
        return np.array([1 - u[0] - u[1], u[0], u[1]]), abs(np.dot(point - a, normal)) / np.linalg.norm(normal)
    best = (None, np.inf)
    for i, j in ((0, 1), (1, 2), (2, 0)):
        edge = corners[j] - corners[i]
        t = np.clip(np.dot(point - corners[i], edge) / np.dot(edge, edge), 0, 1)
        distance = np.linalg.norm(corners[i] + t * edge - point)
        if distance < best[1]:
            weights = np.zeros(3)
            weights[i], weights[j] = 1 - t, t
            best = (weights, distance)
    return best


def krylov(solid, loads):
    """An orthonormal basis that holds the answers to the loads at each rate, and the uniform temperature."""
    A, M = solid.nominal()
    scale = np.sqrt(M.diagonal())
    blocks = []
    for shift in SHIFTS_1_S:
        answers = sparse_linalg.splu((A + shift * M).tocsc()).solve(loads)
        blocks.append(answers)
    blocks.append(np.stack([(solid.part_of_node == p).astype(float) for p in range(len(solid.names))], axis=1))
    answers = np.concatenate(blocks, axis=1) * scale[:, None]
    answers /= np.linalg.norm(answers, axis=0)
    left, singular, _ = np.linalg.svd(answers, full_matrices=False)
    kept = left[:, singular > KEPT * singular[0]]
    return kept / scale[:, None]


def reduce(name, folder):
    """Makes and stores the reduced model of a structure; returns its file."""
    from machines import MACHINES  # the loads and sensors that its cases need

    solid = Solid(STRUCTURES[name](), folder / name)
    machine = MACHINES[name]
    loads = machine.loads(solid)
    readings = machine.readings(solid)
    surfaces = {f"surface {s}": np.asarray(f.sum(axis=1)).ravel() for s, f in zip(solid.surface_names, solid.F)}
    jumps = {}
    for pair, contact in zip(solid.interfaces, solid.C):
        side = (solid.part_of_node == solid.names.index(pair[0])).astype(float)
        jumps[f"jump {pair}"] = contact @ side
    everything = [v for v in list(loads.values()) + list(surfaces.values()) + list(jumps.values()) if np.any(v)]
    V = krylov(solid, np.stack([v / np.linalg.norm(v) for v in everything], axis=1))
    data = {"size": np.array([len(solid.points), V.shape[1]])}
    uniform = np.ones(len(solid.points))
    A, M = solid.nominal()
    # Coordinates of the uniform temperature: it lies in the space.
    data["uniform"] = np.linalg.lstsq(V * np.sqrt(M.diagonal())[:, None], uniform * np.sqrt(M.diagonal()), rcond=None)[0]
    for i, part in enumerate(solid.names):
        data[f"K {part}"] = V.T @ (solid.K[i] @ V)
        data[f"M {part}"] = V.T @ (solid.M[i] @ V)
        data[f"mean {part}"] = (solid.M[i] @ uniform) @ V / (solid.M[i] @ uniform).sum()
        data[f"volume_m3 {part}"] = np.array(solid.M[i].sum())
    for i, surface in enumerate(solid.surface_names):
        data[f"F {surface}"] = V.T @ (solid.F[i] @ V)
        data[f"f {surface}"] = (solid.F[i] @ uniform) @ V
        data[f"area_m2 {surface}"] = np.array(solid.F[i].sum())
    for pair, contact in zip(solid.interfaces, solid.C):
        data[f"C {pair[0]}|{pair[1]}"] = V.T @ (contact @ V)
        side = (solid.part_of_node == solid.names.index(pair[0])).astype(float)
        data[f"area_m2 {pair[0]}|{pair[1]}"] = np.array(side @ contact @ side)
        # Heat that passes from the first part to the second, per W/(m2 K).
        data[f"J {pair[0]}|{pair[1]}"] = (side @ contact) @ V
    for key, load in loads.items():
        data[f"load {key}"] = load @ V
    for key, row in machine.averages(solid).items():
        data[f"average {key}"] = row @ V
    for key, row in readings.items():
        data[f"reading {key}"] = row @ V
    for channel, rows in solid.g.items():
        for i, part in enumerate(solid.names):
            data[f"g {channel} {part}"] = rows[i] @ V
    check = compare(solid, V, loads)
    data["error"] = np.array(check)
    path = folder / f"{name}.npz"
    np.savez_compressed(path, **data)
    print(f"{name}: {len(solid.points)} nodes, {V.shape[1]} states, reduced against full {100 * check:.3f} %")
    return path


def compare(solid, V, loads, step_s=60.0, steps=60):
    """Largest difference of the reduced to the full model in an hour of the first load, relative to the largest rise."""
    A, M = solid.nominal()
    load = next(iter(loads.values()))
    full = sparse_linalg.splu((M / step_s + A).tocsc())
    Ar, Mr = V.T @ (A @ V), V.T @ (M @ V)
    small = np.linalg.inv(Mr / step_s + Ar)
    T, t = np.zeros(len(load)), np.zeros(V.shape[1])
    for _ in range(steps):
        T = full.solve(M @ T / step_s + load)
        t = small @ (Mr @ t / step_s + V.T @ load)
    return float(np.max(np.abs(V @ t - T)) / np.max(np.abs(T)))


if __name__ == "__main__":
    target = pathlib.Path(sys.argv[1])
    for which in sys.argv[2:] or list(STRUCTURES):
        reduce(which, target)
