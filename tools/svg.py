# SPDX-License-Identifier: MIT
"""Pictures as SVG text, for tools/diagrams.py and tools/zlists.py."""
import html

INK, GREY, PALE = "#222222", "#888888", "#e8e8e8"
BLUE, ORANGE, GREEN, PINK = "#1f78b4", "#e08214", "#33a02c", "#d0006f"


class Picture:
    """Shapes in pixels, x to the right and y down, on white."""

    def __init__(self, width, height, title):
        self.lines = ['<svg xmlns="http://www.w3.org/2000/svg" width="%d" height="%d" viewBox="0 0 %d %d"'
                      ' font-family="sans-serif" font-size="13">' % (width, height, width, height),
                      "<!-- SPDX-License-Identifier: MIT -->",
                      "<title>%s</title>" % html.escape(title),
                      '<rect width="%d" height="%d" fill="#ffffff"/>' % (width, height)]
        self.heads = set()

    def add(self, name, text="", **said):
        """An element; fill_opacity="0.2" becomes fill-opacity, a number has at most one decimal."""
        words = ['%s="%s"' % (key.replace("_", "-"), "%g" % round(value, 1) if isinstance(value, float) else value)
                 for key, value in said.items() if value is not None]
        end = ">%s</%s>" % (text, name) if text else "/>"
        self.lines.append("<%s %s%s" % (name, " ".join(words), end))

    def text(self, x, y, text, anchor="start", colour=INK, size=None, bold=False):
        """Lines of text; the foot of the first one is at y."""
        for i, line in enumerate(text.split("\n")):
            self.add("text", html.escape(line), x=float(x), y=float(y + 16 * i), fill=colour,
                     text_anchor=None if anchor == "start" else anchor, font_size=size,
                     font_weight="bold" if bold else None)

    def rect(self, x, y, width, height, fill="none", stroke=None, opacity=None, dash=None, round_by=None, thick=None):
        self.add("rect", x=float(x), y=float(y), width=float(width), height=float(height), fill=fill, stroke=stroke,
                 fill_opacity=opacity, stroke_dasharray=dash, rx=round_by, stroke_width=thick)

    def path(self, points, stroke=INK, fill="none", thick=1.5, dash=None, opacity=None, closed=False, arrow=False):
        said = "M" + " L".join("%g %g" % (round(x, 1), round(y, 1)) for x, y in points) + ("Z" if closed else "")
        self.curve(said, stroke, fill, thick, dash, opacity, arrow)

    def curve(self, said, stroke=INK, fill="none", thick=1.5, dash=None, opacity=None, arrow=False):
        """A path in SVG's own notation."""
        if arrow:
            self.head(stroke)
        self.add("path", d=said, fill=fill, stroke=stroke, stroke_width=thick, stroke_dasharray=dash,
                 fill_opacity=opacity, marker_end="url(#%s)" % self.head_name(stroke) if arrow else None)

    def circle(self, x, y, radius, fill=INK, stroke=None):
        self.add("circle", cx=float(x), cy=float(y), r=radius, fill=fill, stroke=stroke)

    def measure(self, x, low, high, text, colour=INK, left=False):
        """A vertical distance between two heights, with a tick at both ends and its name beside it."""
        self.path([(x, low), (x, high)], colour)
        for y in (low, high):
            self.path([(x - 5, y), (x + 5, y)], colour)
        self.text(x - 9 if left else x + 9, (low + high) / 2 + 5, text, "end" if left else "start", colour)

    @staticmethod
    def head_name(colour):
        return "head" + colour.lstrip("#")

    def head(self, colour):
        """An arrow's head in this colour, defined once."""
        if colour not in self.heads:
            self.heads.add(colour)
            self.add("marker", '<path d="M0 0 L8 4 L0 8 Z" fill="%s"/>' % colour, id=self.head_name(colour),
                     markerWidth=8, markerHeight=8, refX=7, refY=4, orient="auto", markerUnits="userSpaceOnUse")

    def string(self):
        return "\n".join(self.lines) + "\n</svg>\n"
