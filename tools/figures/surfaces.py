"""Meshes in PLY, and analytic shapes to compare them with."""
import numpy


def read_ply(path):
    """The vertices of a binary PLY, as a structured array by property name."""
    raw = path.read_bytes()
    end = raw.index(b"end_header\n") + len(b"end_header\n")
    types = {"float": "<f4", "uchar": "u1", "ushort": "<u2", "int": "<i4", "uint": "<u4"}
    columns, counts, element = [], {}, None
    for line in raw[:end].decode().splitlines():
        words = line.split()
        if words[0] == "element":
            element = words[1]
            counts[element] = int(words[2])
        if words[0] == "property" and element == "vertex":
            columns.append((words[2], types[words[1]]))
    return numpy.frombuffer(raw, numpy.dtype(columns), counts["vertex"], end)


def read_triangles(path):
    """The triangles of a PLY that the program wrote: faces come last, 13 bytes each, or 14 with a mark."""
    raw = path.read_bytes()
    head = raw[: raw.index(b"end_header\n")].decode()
    count = int(head.split("element face ")[1].split()[0])
    kind = [("n", "u1"), ("v", "<i4", 3)] + ([("mark", "u1")] if "mark" in head.split("element face ")[1] else [])
    return numpy.frombuffer(raw[-count * numpy.dtype(kind).itemsize :], numpy.dtype(kind), count)["v"]


def points_of(vertices):
    return numpy.stack([vertices[axis].astype(float) for axis in "xyz"], axis=1)


def fit_sphere(points, centre, radius):
    """Centre, radius and RMS residual of the sphere of least squares, from a first estimate."""
    for _ in range(30):
        away = points - centre
        distance = numpy.linalg.norm(away, axis=1)
        jacobian = numpy.c_[-away / distance[:, None], -numpy.ones(len(points))]
        step = numpy.linalg.lstsq(jacobian, radius - distance, rcond=None)[0]
        centre, radius = centre + step[:3], radius + step[3]
    return centre, radius, numpy.sqrt(numpy.mean((distance - radius) ** 2))


def fit_ball(points, centre, radius=20.0, within=0.5):
    """Centre, radius and RMS residual of a ball of the ball bar, from the points above its post and near the nominal sphere."""
    centre = numpy.asarray(centre, float)
    near = (points[:, 2] > 47) & (numpy.abs(numpy.linalg.norm(points - centre, axis=1) - radius) < within)
    return fit_sphere(points[near], centre, radius)


def box(p, low, high):
    low, high = numpy.array(low, float), numpy.array(high, float)
    q = numpy.abs(p - (low + high) / 2) - (high - low) / 2
    return numpy.linalg.norm(numpy.maximum(q, 0), axis=1) + numpy.minimum(q.max(axis=1), 0)


def cylinder(p, x, y, radius, low, high):
    q = numpy.stack(
        [numpy.hypot(p[:, 0] - x, p[:, 1] - y) - radius, numpy.abs(p[:, 2] - (low + high) / 2) - (high - low) / 2],
        axis=1,
    )
    return numpy.linalg.norm(numpy.maximum(q, 0), axis=1) + numpy.minimum(q.max(axis=1), 0)


def vertex_normals(points, triangles):
    corners = [points[triangles[:, i]] for i in range(3)]
    cross = numpy.cross(corners[1] - corners[0], corners[2] - corners[0])
    sums = numpy.zeros_like(points)
    for i in range(3):
        numpy.add.at(sums, triangles[:, i], cross)
    return sums / numpy.maximum(numpy.linalg.norm(sums, axis=1), 1e-12)[:, None]


def distance_to_triangles(points, a, b, c):
    """The distance of each point to its own triangle."""

    def to_segment(p, q):
        along = q - p
        t = numpy.clip(((points - p) * along).sum(1) / numpy.maximum((along**2).sum(1), 1e-12), 0, 1)
        return numpy.linalg.norm(points - p - t[:, None] * along, axis=1)

    normal = numpy.cross(b - a, c - a)
    normal /= numpy.maximum(numpy.linalg.norm(normal, axis=1), 1e-12)[:, None]
    off = ((points - a) * normal).sum(1)
    foot = points - off[:, None] * normal
    inside = numpy.ones(len(points), bool)
    for p, q in ((a, b), (b, c), (c, a)):
        inside &= (numpy.cross(q - p, foot - p) * normal).sum(1) >= 0
    return numpy.where(
        inside, numpy.abs(off), numpy.minimum(numpy.minimum(to_segment(a, b), to_segment(b, c)), to_segment(c, a))
    )


def rms(values):
    return numpy.sqrt(numpy.mean(numpy.square(values)))
