"""Small files of every format, made from a few points; tests then spoil them. Standard library only."""
import struct

POINTS = [(0.0, 0.0, 0.0), (1.5, 0.0, 0.25), (0.0, -2.0, 0.5), (1.0, 1.0, 3.0)]
CODES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f",
         "double": "d", "int64": "q", "uint64": "Q"}


def ply_header(*lines, form="ascii 1.0"):
    return "\n".join(["ply", f"format {form}", *lines, "end_header"]) + "\n"


def ply(form="ascii", points=POINTS, scalar="float", faces=()):
    """Faces, when there are any, come after the vertices."""
    full = {"ascii": "ascii", "little": "binary_little_endian", "big": "binary_big_endian"}[form]
    lines = [f"element vertex {len(points)}", *[f"property {scalar} {axis}" for axis in "xyz"], "property uchar red"]
    if faces:
        lines += [f"element face {len(faces)}", "property list uchar int vertex_indices"]
    header = ply_header(*lines, form=full + " 1.0").encode()
    if form == "ascii":
        rows = [f"{x} {y} {z} {i}" for i, (x, y, z) in enumerate(points)]
        rows += [" ".join(map(str, [len(face), *face])) for face in faces]
        return header + "".join(row + "\n" for row in rows).encode()
    order = "<" if form == "little" else ">"
    body = b"".join(struct.pack(order + "3" + CODES[scalar] + "B", *p, i) for i, p in enumerate(points))
    return header + body + b"".join(struct.pack(f"{order}B{len(face)}i", len(face), *face) for face in faces)


def pcd_header(fields="x y z", size="4 4 4", kind="F F F", count="1 1 1", width=4, height=1, points=4, data="ascii",
               leave_out=()):
    lines = {"VERSION": "0.7", "FIELDS": fields, "SIZE": size, "TYPE": kind, "COUNT": count, "WIDTH": width,
             "HEIGHT": height, "VIEWPOINT": "0 0 0 1 0 0 0", "POINTS": points, "DATA": data}
    return "".join(f"{key} {value}\n" for key, value in lines.items() if key not in leave_out)


def pcd(data="ascii", points=POINTS, **header):
    header = pcd_header(width=len(points), points=len(points), data=data, **header).encode()
    if data == "ascii":
        return header + "".join(f"{x} {y} {z}\n" for x, y, z in points).encode()
    if data == "binary":
        return header + b"".join(struct.pack("<3f", *p) for p in points)
    flat = b"".join(struct.pack(f"<{len(points)}f", *(p[axis] for p in points)) for axis in range(3))
    packed = lzf_literals(flat)
    return header + struct.pack("<2I", len(packed), len(flat)) + packed


def lzf_literals(data):
    """LZF without repetitions: every run of up to 32 bytes as it is."""
    runs = [data[i:i + 32] for i in range(0, len(data), 32)]
    return b"".join(bytes([len(run) - 1]) + run for run in runs)


LAS_SIZES = [20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67]  # of a point, by point format
LAS_HEADERS = [227, 227, 227, 235, 375]  # by minor version


def las(minor=2, point_format=0, points=POINTS, scale=0.25, offset=0.0, records=(), extended=(), changes=None):
    """`records` are (user id, number, data). `changes` spoil header fields, by the names below."""
    changes = changes or {}
    header_size = LAS_HEADERS[minor]
    body = b"".join(struct.pack("<H16sHH32s", 0, user, number, len(data), b"") + data for user, number, data in records)
    after = b"".join(struct.pack("<H16sHQ32s", 0, user, number, len(data), b"") + data for user, number, data in extended)
    length = changes.get("record_length", LAS_SIZES[point_format])
    stored = b"".join(
        struct.pack("<3i", *(round((c - offset) / scale) for c in p)).ljust(LAS_SIZES[point_format], b"\0") for p in points)
    legacy = len(points) if point_format < 6 else 0
    start = header_size + len(body)
    fields = {"signature": (0, "4s", b"LASF"), "encoding": (6, "H", 0), "major": (24, "B", 1), "minor": (25, "B", minor),
              "header_size": (94, "H", header_size), "start": (96, "I", start), "record_count": (100, "I", len(records)),
              "point_format": (104, "B", point_format), "record_length": (105, "H", length), "legacy": (107, "I", legacy),
              "scale": (131, "d", scale), "scale_y": (139, "d", scale), "scale_z": (147, "d", scale),
              "offset": (155, "d", offset), "offset_y": (163, "d", offset), "offset_z": (171, "d", offset)}
    if minor >= 3:
        fields["waveforms"] = (227, "Q", 0)
    if minor >= 4:
        fields["extended_start"] = (235, "Q", start + len(stored) if extended else 0)
        fields["extended_count"] = (243, "I", len(extended))
        fields["count"] = (247, "Q", len(points))
    header = bytearray(header_size)
    for name, (at, code, value) in fields.items():
        struct.pack_into("<" + code, header, at, changes.get(name, value))
    return bytes(header) + body + stored + after


def off(points=POINTS, faces=((0, 1, 2),), word="OFF"):
    rows = [word, f"{len(points)} {len(faces)} 0", *[f"{x} {y} {z}" for x, y, z in points]]
    rows += [" ".join(map(str, [len(face), *face])) for face in faces]
    return "".join(row + "\n" for row in rows).encode()


def obj(points=POINTS, faces=((1, 2, 3),)):
    rows = [f"v {x} {y} {z}" for x, y, z in points] + ["f " + " ".join(map(str, face)) for face in faces]
    return "".join(row + "\n" for row in rows).encode()


TRIANGLES = [(POINTS[0], POINTS[1], POINTS[2]), (POINTS[0], POINTS[2], POINTS[3])]


def stl_ascii(triangles=TRIANGLES, name="part"):
    text = f"solid {name}\n"
    for corners in triangles:
        text += "facet normal 0 0 1\nouter loop\n"
        text += "".join(f"vertex {x} {y} {z}\n" for x, y, z in corners)
        text += "endloop\nendfacet\n"
    return (text + f"endsolid {name}\n").encode()


def stl_binary(triangles=TRIANGLES, title=b"a part", count=None):
    facets = b"".join(struct.pack("<3f", 0, 0, 1) + b"".join(struct.pack("<3f", *c) for c in corners) + b"\0\0"
                      for corners in triangles)
    return title.ljust(80, b"\0") + struct.pack("<I", len(triangles) if count is None else count) + facets


def xyz(points=POINTS, delimiter=" ", end="\n", header=None):
    rows = [delimiter.join(map(str, p)) for p in points]
    return "".join(row + end for row in ([header] if header else []) + rows).encode()


def samples():
    """Name -> a valid file of the four points."""
    faces = ((0, 1, 2), (0, 2, 3))
    files = {f"{form}.ply": ply(form, faces=faces) for form in ("ascii", "little", "big")}
    files.update({f"{data}.pcd": pcd(data) for data in ("ascii", "binary", "binary_compressed")})
    extra = [(b"LASF_Spec", 4, struct.pack("<2xBB32s156x", 3, 0, b"extra"))]
    files.update({"1.2.las": las(2, 3), "1.0.las": las(0, 1), "1.4.las": las(4, 7, extended=[(b"someone", 7, b"text")]),
                  "vlr.las": las(4, 6, points=(), records=extra, changes={"record_length": 32})})
    files.update({"a.off": off(), "a.obj": obj(), "ascii.stl": stl_ascii(), "binary.stl": stl_binary()})
    files.update({"blank.xyz": xyz(), "named.csv": xyz(delimiter=",", header="x,y,z"), "semicolon.txt": xyz(delimiter=";")})
    return files
