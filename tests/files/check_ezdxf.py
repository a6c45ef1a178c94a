"""Reads and audits a DXF with ezdxf and prints the number of its faces, their extents, and the extents in
the header: "FACES LOW HIGH LOW HIGH", each three numbers. Fails when the audit reports anything."""
import sys

import ezdxf

document = ezdxf.readfile(sys.argv[1])
auditor = document.audit()
findings = auditor.errors + auditor.fixes
for finding in findings:
    print(finding.message, file=sys.stderr)

faces, corners = 0, []
for entity in document.modelspace():
    if entity.dxf.layer not in ("SCAN", "SCAN_DISPLACED", "SCAN_SYNTHESIZED"):
        sys.exit(f"an entity is on layer {entity.dxf.layer}")
    if entity.dxf.layer not in document.layers:
        sys.exit(f"layer {entity.dxf.layer} is not in the table")
    if entity.dxftype() == "3DFACE":
        faces += 1
        corners += entity.wcs_vertices()
    elif entity.dxftype() == "MESH":
        faces += len(entity.faces)
        corners += [entity.vertices[index] for face in entity.faces for index in face]
    else:
        for face in entity.faces():  # the last vertex is the face record
            faces += 1
            corners += [vertex.dxf.location for vertex in face[:-1]]

low = [min(corner[axis] for corner in corners) for axis in range(3)]
high = [max(corner[axis] for corner in corners) for axis in range(3)]
claimed = [*document.header["$EXTMIN"], *document.header["$EXTMAX"]]
print(faces, *(f"{number:.4f}" for number in [*low, *high, *claimed]))
sys.exit(bool(findings))
