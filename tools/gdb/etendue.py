"""GDB pretty printers: vectors, colours, rays, hits and path states on one line.

    (gdb) source tools/gdb/etendue.py
    (gdb) print paths.state(0)
    $1 = path(throughput=(0.5, 0.5, 0.5) radiance=(0, 0, 0) from=(0, 1, 3) pdf=0.32 ...)
"""
import gdb
import gdb.printing


def number(value):
    return "%.6g" % float(value)


def vector(value, fields):
    return "(" + ", ".join(number(value[f]) for f in fields) + ")"


class Vector:
    """glm::vec<N, float>: (x, y, z)"""

    def __init__(self, value):
        self.value = value

    def to_string(self):
        return vector(self.value, "xyzw"[: int(self.value.type.template_argument(0))])


class Colour:
    """etendue::Rgb: rgb(r, g, b)"""

    def __init__(self, value):
        self.value = value

    def to_string(self):
        return "rgb" + vector(self.value, "rgb")


def plain(type_name, fields):
    """A printer that shows the given members in one line."""

    class Plain:
        def __init__(self, value):
            self.value = value

        def to_string(self):
            known = [f.name for f in self.value.type.fields()]
            shown = []
            for f in fields:
                if f not in known:
                    continue
                member = self.value[f]
                code = member.type.strip_typedefs().code
                text = number(member) if code == gdb.TYPE_CODE_FLT else member.format_string()
                shown.append(f + "=" + text)
            return type_name + "(" + " ".join(shown) + ")"

    return Plain


def build():
    printers = gdb.printing.RegexpCollectionPrettyPrinter("etendue")
    printers.add_printer("vec", "^glm::vec<[234], float, .*>$", Vector)
    printers.add_printer("Rgb", "^etendue::Rgb$", Colour)
    printers.add_printer("Ray", "^etendue::Ray$", plain("ray", ["origin", "direction", "tnear", "tfar"]))
    printers.add_printer("Hit", "^etendue::Hit$", plain("hit", ["instance", "triangle", "u", "v", "t"]))
    printers.add_printer(
        "PathState",
        "^etendue::transport::PathState<.*>$",
        plain("path", ["throughput", "radiance", "from", "pdf", "eta_scale", "time", "seed", "all_specular"]),
    )
    printers.add_printer(
        "SurfacePoint",
        "^etendue::scene::SurfacePoint$",
        plain("point", ["position", "ng", "triangle", "offset", "front"]),
    )
    printers.add_printer(
        "LightSample", "^etendue::LightSample$", plain("light", ["wi", "distance", "radiance", "pdf", "delta"])
    )
    printers.add_printer(
        "LobeSample",
        "^etendue::LobeSample<.*>$",
        plain("sample", ["wi", "weight", "pdf_solid_angle", "eta", "scatter", "delta", "transmitted"]),
    )
    return printers


gdb.printing.register_pretty_printer(gdb.current_objfile(), build(), replace=True)
