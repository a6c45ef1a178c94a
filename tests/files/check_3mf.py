"""Reads a 3MF in strict mode with lib3mf, the reader of the 3MF Consortium, and prints the number of its
triangles and whether it is closed, manifold and oriented: "TRIANGLES 0|1". Fails when lib3mf warns."""
import ctypes
import sys

lib = ctypes.CDLL("lib3MF.so.1")


def call(name, *arguments):
    code = getattr(lib, "lib3mf_" + name)(*arguments)
    if code != 0:
        sys.exit(f"lib3mf_{name} answers {code & 0xFFFFFFFF:#x}")


def number():
    return ctypes.c_uint32(0)


model, reader, objects, mesh = (ctypes.c_void_p() for _ in range(4))
call("createmodel", ctypes.byref(model))
call("model_queryreader", model, b"3mf", ctypes.byref(reader))
call("reader_setstrictmodeactive", reader, 1)
call("reader_readfromfileutf8", reader, sys.argv[1].encode())
warnings = number()
call("reader_getwarningcount", reader, ctypes.byref(warnings))
call("model_getmeshobjects", model, ctypes.byref(objects))
more, triangles, solid = number(), 0, 1
while True:
    call("resourceiterator_movenext", objects, ctypes.byref(more))
    if not more.value:
        break
    call("resourceiterator_getcurrent", objects, ctypes.byref(mesh))
    count, is_solid = number(), number()
    call("meshobject_gettrianglecount", mesh, ctypes.byref(count))
    call("meshobject_ismanifoldandoriented", mesh, ctypes.byref(is_solid))
    triangles += count.value
    solid &= is_solid.value
print(triangles, solid)
sys.exit(warnings.value != 0)
