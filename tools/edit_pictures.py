"""Draws the mesh before and after each operation of docs/editing.md.

    python3 tools/edit_pictures.py PROGRAM docs/images/editing [NAME ...]

The mesh is a simulated scan of the bust, for some operations of the bracket. With names, draws only those pictures.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent / "figures"))

from scans import Scans  # noqa: E402

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
OUT = pathlib.Path(sys.argv[2]).resolve()
ONLY = set(sys.argv[3:])
WORK = pathlib.Path(tempfile.mkdtemp(prefix="frangia-edit-pictures-"))
OUT.mkdir(parents=True, exist_ok=True)


def run(*arguments):
    subprocess.run([PROGRAM, "--quiet", *map(str, arguments)], check=True)


def edit(source, target, *arguments):
    run("edit", source, *arguments, "-o", target)


def scan(part):
    mesh = WORK / f"{part}.ply"
    run("reconstruct", Scans(PROGRAM).made("simulate", part, "--rig", "digital"), "-o", mesh)
    return mesh


def show(name, before, after, *options):
    run(
        "picture",
        before,
        after,
        "-o",
        OUT / f"{name}.png",
        "--width",
        320,
        "--height",
        320,
        "--marks",
        "--no-legend",
        *options,
    )


def picture(name, before, steps, *options):
    """Draws the mesh before and after the steps with the same options."""
    if ONLY and name not in ONLY:
        return
    after = WORK / f"{name}.ply"
    edit(before, after, *steps)
    show(name, before, after, *options)


bust = scan("bust")
bracket = scan("bracket")
face = WORK / "face.ply"  # a part of the head in which triangles are visible
edit(
    bust, face, "--keep-largest", 1, "--select-box", "-40,-40,62,40,40,100", "--invert", "--delete", "--keep-largest", 1
)
mask = WORK / "mask.ply"
edit(face, mask, "--select-ball", "22,0,80,13", "--invert", "--delete", "--keep-largest", 1)

if not ONLY or "preview" in ONLY:
    run("edit", bust, "--remove-islands", "60mm", "--fill-holes", "200mm", "--preview", OUT / "preview.png")
picture("remove-islands", bust, ["--remove-islands", "60mm"])
largest = WORK / "largest.ply"
edit(bust, largest, "--keep-largest", 1)
picture("fill-holes", largest, ["--fill-holes", "200mm"])
picture("fill-holes-flat", largest, ["--fill-holes-flat", "200mm"])
picture("delete", largest, ["--select-box", "-60,-60,0,60,60,55", "--delete"])
picture("select-normal", bracket, ["--select-normal", "0,0,1,15deg", "--delete"])
picture("select-sigma", bust, ["--select-sigma", "0.03mm", "--grow", 1, "--delete"])
picture("select-views", bust, ["--select-views", 2, "--delete"])
picture("select-curvature", bracket, ["--select-curvature", "0.6", "--delete"])
picture("smooth", mask, ["--max-sigmas", 0, "--smooth", 30])
picture("smooth-keeping-edges", bracket, ["--smooth-keeping-edges", 8])
picture("decimate", mask, ["--decimate", "0.03mm"], "--edges")
picture("decimate-to", mask, ["--decimate-to", 600], "--edges")
picture("remesh", mask, ["--remesh", "1.2mm"], "--edges")
picture("cut", largest, ["--cut", "0,0,1,50mm"])
closed = WORK / "closed.ply"
edit(bust, closed, "--keep-largest", 1, "--fill-holes-flat", "200mm")
picture("cut-capped", closed, ["--cut-capped", "0,0.3,-1,-70mm"])
halves = WORK / "halves.ply"
edit(closed, halves, "--select-box", "-60,-60,46,60,60,58", "--delete", "--keep-largest", 2)
picture("bridge", halves, ["--bridge", "0,1"])
picture("mirror", bust, ["--mirror", "1,0,0,0mm"])
picture("align", bracket, ["--align", "-30,0,35,-10,25,3,-27,0,70"])
picture("offset", bracket, ["--offset", "2mm"])


def write_ply(path, vertices, triangles):
    """Writes an ASCII PLY file."""
    lines = [
        "ply",
        "format ascii 1.0",
        f"element vertex {len(vertices)}",
        "property float x",
        "property float y",
        "property float z",
    ]
    lines += [f"element face {len(triangles)}", "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(map(str, vertex)) for vertex in vertices]
    lines += [f"3 {a} {b} {c}" for a, b, c in triangles]
    path.write_text("\n".join(lines) + "\n")


def read_off(path):
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    count, faces = (int(word) for word in lines[1].split()[:2])
    vertices = [[float(word) for word in line.split()] for line in lines[2 : 2 + count]]
    return vertices, [[int(word) for word in line.split()[1:4]] for line in lines[2 + count : 2 + count + faces]]


def broken(name, change):
    """Writes the mask with a fault that `change` introduces."""
    edit(mask, WORK / "mask.off")
    vertices, triangles = read_off(WORK / "mask.off")
    path = WORK / f"{name}-before.ply"
    write_ply(path, *change(vertices, triangles))
    return path


def spikes(vertices, triangles):
    for i in range(40, len(vertices), len(vertices) // 12):
        vertices[i] = [2 * vertices[i][axis] - middle for axis, middle in enumerate((16, 0, 80))]
    return vertices, triangles


def intersecting(vertices, triangles):
    """Makes pairs of spikes that intersect each other."""
    vertices = [list(vertex) for vertex in vertices]
    for height in (72, 80, 88):
        left, right = (
            min(range(len(vertices)), key=lambda i: sum((v - m) ** 2 for v, m in zip(vertices[i], (17, y, height))))
            for y in (-4, 4)
        )
        (xl, yl, zl), (xr, yr, zr) = vertices[left], vertices[right]
        vertices[left], vertices[right] = [xl + 12, 2 * yr - yl, 2 * zr - zl], [xr + 12, 2 * yl - yr, 2 * zl - zr]
    return vertices, triangles


def flipped(vertices, triangles):
    return vertices, [t if i % 5 else t[::-1] for i, t in enumerate(triangles)]


def unconnected(vertices, triangles):
    """Gives each triangle its own vertices and shrinks it by 7 %."""
    places, faces = [], []
    for t in triangles:
        middle = [sum(vertices[v][axis] for v in t) / 3 for axis in range(3)]
        faces.append([len(places), len(places) + 1, len(places) + 2])
        places += [[middle[axis] + 0.93 * (vertices[v][axis] - middle[axis]) for axis in range(3)] for v in t]
    return places, faces


picture("remove-spikes", broken("spikes", spikes), ["--remove-spikes"])
picture("remove-self-intersections", broken("intersecting", intersecting), ["--remove-self-intersections"])


def ball(centre, radius, rings=48):
    """Returns the vertices and triangles of a sphere of rings and meridians."""
    from math import cos, pi, sin

    vertices = [[centre[0], centre[1], centre[2] + radius]]
    for i in range(1, rings):
        for j in range(2 * rings):
            polar, turn = pi * i / rings, pi * j / rings
            vertices.append(
                [
                    centre[0] + radius * sin(polar) * cos(turn),
                    centre[1] + radius * sin(polar) * sin(turn),
                    centre[2] + radius * cos(polar),
                ]
            )
    vertices.append([centre[0], centre[1], centre[2] - radius])

    def at(i, j):
        return 1 + (i - 1) * 2 * rings + j % (2 * rings)

    faces = []
    for j in range(2 * rings):
        faces += [[0, at(1, j), at(1, j + 1)], [len(vertices) - 1, at(rings - 1, j + 1), at(rings - 1, j)]]
        for i in range(1, rings - 1):
            faces += [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]
    return vertices, faces


if not ONLY or "unite" in ONLY:
    (v, f), (w, g) = ball((0, 0, 0), 10), ball((12, 2, 4), 8)
    bodies, united = WORK / "bodies.ply", WORK / "united.ply"
    write_ply(bodies, v + w, f + [[i + len(v) for i in t] for t in g])
    edit(bodies, united, "--remove-self-intersections")
    for mesh in (bodies, united):
        edit(mesh, mesh, "--cut", "0,1,0,0.5mm")
    show("unite", bodies, united, "--azimuth", -80)
picture("orient", broken("flipped", flipped), ["--orient"])
picture("stitch", broken("unconnected", unconnected), ["--stitch", "0.1mm"], "--edges")
shutil.rmtree(WORK)
