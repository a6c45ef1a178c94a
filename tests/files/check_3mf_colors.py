"""Reads a 3MF in strict mode with lib3mf, the reader of the 3MF Consortium, and prints a line for each triangle:
the red, green and blue of its three corners, or "none"."""
import ctypes
import sys

lib = ctypes.CDLL("lib3MF.so.1")


class Color(ctypes.Structure):
    _fields_ = [(channel, ctypes.c_uint8) for channel in ("red", "green", "blue", "alpha")]


class TriangleColors(ctypes.Structure):
    _fields_ = [("corners", Color * 3)]


def call(name, *arguments):
    code = getattr(lib, "lib3mf_" + name)(*arguments)
    if code != 0:
        sys.exit(f"lib3mf_{name} answers {code & 0xFFFFFFFF:#x}")


model, reader, objects, mesh, properties = (ctypes.c_void_p() for _ in range(5))
call("createmodel", ctypes.byref(model))
call("model_queryreader", model, b"3mf", ctypes.byref(reader))
call("reader_setstrictmodeactive", reader, 1)
call("reader_readfromfileutf8", reader, sys.argv[1].encode())
call("model_getmeshobjects", model, ctypes.byref(objects))
more, count = ctypes.c_uint32(0), ctypes.c_uint32(0)
call("resourceiterator_movenext", objects, ctypes.byref(more))
call("resourceiterator_getcurrent", objects, ctypes.byref(mesh))
call("meshobject_gettrianglecount", mesh, ctypes.byref(count))
call("meshobject_createpropertyhandler", mesh, ctypes.byref(properties))
for triangle in range(count.value):
    kind = ctypes.c_int(0)
    call("propertyhandler_getpropertytype", properties, triangle, ctypes.byref(kind))
    colors = TriangleColors()
    call("propertyhandler_getcolor", properties, triangle, ctypes.byref(colors))
    if kind.value != 2:  # of a material, not of colors
        print("none")
    else:
        print(*(f"{c.red} {c.green} {c.blue}" for c in colors.corners))
