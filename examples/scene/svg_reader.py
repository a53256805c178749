"""Reads an SVG drawing: page size, and every shape with the groups around it.

svgelements does the parsing (transforms, units, viewBox, CSS). Before it sees the drawing, three
things are made plain that it leaves out: `<use>` is replaced by a copy of what it refers to
(also when the definition comes later), `<symbol>` and other definitions are hidden, and style
sheets come first. What the drawing means as a scene is decided in scene_builder.py.
"""

import copy
import gzip
import io
import re
import xml.etree.ElementTree as ET
from dataclasses import dataclass, field

from svgelements import SVG, Group, Length, Matrix, Shape

SVG_NS = "{http://www.w3.org/2000/svg}"
XLINK_HREF = "{http://www.w3.org/1999/xlink}href"
INKSCAPE_LABEL = "{http://www.inkscape.org/namespaces/inkscape}label"

PIXELS_PER_INCH = 96.0  # the CSS pixel, which every unit in an SVG is tied to
# Exact, unlike the pixels per millimetre that svgelements uses.
UNIT_M = {"mm": 1e-3, "cm": 1e-2, "in": 0.0254, "pt": 0.0254 / 72, "pc": 0.0254 / 6}
PHYSICAL_LENGTH = re.compile(r"^\s*(\+?[.\d]+(?:[eE][-+]?\d+)?)\s*(mm|cm|in|pt|pc)\s*$")

# Content of these is drawn only where something refers to it.
DEFINITIONS = {"defs", "symbol", "clipPath", "mask", "marker", "pattern", "filter",
               "linearGradient", "radialGradient", "metadata", "foreignObject"}
MAX_ELEMENTS = 200_000  # copies of copies of <use> grow exponentially: stop in time
MAX_USE_DEPTH = 16


class DrawingError(Exception):
    """The drawing cannot become a scene; the text says what to change."""


@dataclass
class DrawnShape:
    """One visible or guide shape and its surroundings, outermost ancestor first."""

    element: Shape
    chain: list  # own attributes of the ancestors, then of the shape (dicts, CSS applied)

    def attribute(self, name, default=None):
        """The nearest value of an inherited attribute."""
        for attributes in reversed(self.chain):
            value = attributes.get(name)
            if value is not None and value.strip() != "inherit":
                return value.strip()
        return default

    def label(self):
        """A name for messages."""
        own = self.chain[-1]
        return own.get("id") or own.get(INKSCAPE_LABEL) or own.get("tag", "shape")


@dataclass
class Drawing:
    """A page and its shapes; lengths in CSS pixels, y down, until scene_builder converts them."""

    width_px: float
    height_px: float
    metres_per_px: float
    to_page: Matrix  # page user units (viewBox) -> pixels
    attributes: dict  # of the root element
    shapes: list
    by_id: dict
    notices: list = field(default_factory=list)


def local_name(element):
    """Tag without the SVG namespace; foreign elements keep theirs in braces."""
    tag = element.tag
    if not isinstance(tag, str):
        return ""
    return tag[len(SVG_NS):] if tag.startswith(SVG_NS) else tag


def set_name(element, name):
    """Renames an element, staying in its namespace."""
    element.tag = (SVG_NS if element.tag.startswith(SVG_NS) else "") + name


def load_tree(path):
    """The XML root of an .svg or .svgz file."""
    try:
        with open(path, "rb") as file:
            data = file.read()
        if data[:2] == b"\x1f\x8b":
            data = gzip.decompress(data)
    except (OSError, EOFError) as error:
        raise DrawingError(f"cannot read {path}: {error}") from error
    try:
        root = ET.fromstring(data)
    except ET.ParseError as error:
        raise DrawingError(f"{path} is not an SVG drawing (XML: {error})") from error
    if local_name(root) != "svg":
        raise DrawingError(f"{path} is not an SVG drawing (root element <{root.tag}>)")
    return root


def length_px(text, default=0.0):
    """A length attribute in pixels; percentages and nonsense give the default."""
    try:
        value = Length(text).value(ppi=PIXELS_PER_INCH)
        return float(value)
    except (TypeError, ValueError):
        return default


def take_offset(element):
    """Removes x and y, and returns them as a transform text."""
    x = length_px(element.attrib.pop("x", "0"))
    y = length_px(element.attrib.pop("y", "0"))
    return f"translate({x!r},{y!r})"


class Preparer:
    """Rewrites the XML tree in place into what svgelements reads faithfully."""

    def __init__(self, root):
        self.root = root
        self.notices = []
        self.elements = 0
        self.ids = {e.get("id"): e for e in root.iter() if e.get("id")}
        self.styles = "".join(e.text or "" for e in root.iter() if local_name(e) == "style")
        self.originals = {}

    def run(self):
        """Prepares the whole tree; returns what was left out."""
        counts = {name: sum(local_name(e) == name for e in self.root.iter())
                  for name in ("text", "image")}
        if counts["text"]:
            self.notices.append(f"{counts['text']} text element(s) ignored: convert text to paths")
        if counts["image"]:
            self.notices.append(f"{counts['image']} bitmap image(s) ignored")
        if any(e.get("clip-path") or e.get("mask") or "clip-path:" in e.get("style", "")
               for e in self.root.iter()):
            self.notices.append("clip paths and masks are ignored: shapes are taken whole")
        self.prepare_children(self.root, 0)
        if self.styles:
            style = ET.Element(self.root.tag[:-len("svg")] + "style")
            style.text = self.styles
            self.root.insert(0, style)
        for name in ("x", "y"):  # have no meaning on the root element
            self.root.attrib.pop(name, None)
        return self.notices

    def prepare_children(self, parent, use_depth):
        """Depth first; replaces children that need it."""
        kept = []
        for child in list(parent):
            self.elements += 1
            if self.elements > MAX_ELEMENTS:
                raise DrawingError(f"more than {MAX_ELEMENTS} elements after expanding <use>")
            name = local_name(child)
            if name in ("", "style", "text", "image", "title", "desc"):
                continue
            if name == "use":
                child = self.expanded_use(child, use_depth)
                if child is None:
                    continue
                self.prepare_children(child, use_depth + 1)
            else:
                if name in DEFINITIONS:
                    set_name(child, "g")
                    child.attrib.pop("style", None)
                    child.set("display", "none")
                elif name in ("a", "switch"):
                    set_name(child, "g")
                self.prepare_children(child, use_depth)
                if name == "svg":
                    child = self.nested_page(child)
            kept.append(child)
        parent[:] = kept

    def expanded_use(self, use, use_depth):
        """A group with a copy of what <use> refers to, or None."""
        reference = use.attrib.pop(XLINK_HREF, None)
        reference = use.attrib.pop("href", reference)
        target = self.ids.get((reference or "").lstrip("#"))
        if target is None or use_depth >= MAX_USE_DEPTH:
            self.notices.append(f"<use> of {reference!r} ignored: no such element, or in a circle")
            return None
        size = {name: use.attrib.pop(name, "100%") for name in ("width", "height")}
        set_name(use, "g")
        use.set("transform", use.get("transform", "") + " " + take_offset(use))
        inner = copy.deepcopy(self.originals.get(id(target), target))
        if local_name(inner) == "symbol":
            set_name(inner, "svg" if inner.get("viewBox") else "g")
            inner.attrib.update(size if inner.get("viewBox") else {})
        use[:] = [inner]
        return use

    def keep_originals(self):
        """Copies what <use> refers to, before prepare_children renames and empties elements."""
        wanted = set()
        for element in self.root.iter():
            if local_name(element) == "use":
                wanted.add(element.get("href", element.get(XLINK_HREF, "")).lstrip("#"))
        for name in wanted & self.ids.keys():
            self.originals[id(self.ids[name])] = copy.deepcopy(self.ids[name])

    @staticmethod
    def nested_page(page):
        """A nested <svg>: its x and y become a group around it, its size is stated."""
        group = ET.Element(page.tag[:-len("svg")] + "g", {"transform": take_offset(page)})
        for name in ("width", "height"):
            page.attrib.setdefault(name, "100%")
        group.append(page)
        return group


def state_page_size(root):
    """Fills in a missing width or height from the viewBox, which keeps the aspect ratio."""
    box = [float(v) for v in re.findall(r"[-+.\deE]+", root.get("viewBox", ""))]
    has = {name: bool(root.get(name)) and not root.get(name).strip().endswith("%")
           for name in ("width", "height")}
    if len(box) != 4 or box[2] <= 0 or box[3] <= 0:
        if not (has["width"] and has["height"]):
            raise DrawingError("the drawing states no page size (width and height, or viewBox)")
        root.attrib.pop("viewBox", None)
        return
    for name, other, ratio in (("width", "height", box[2] / box[3]),
                               ("height", "width", box[3] / box[2])):
        if has[name]:
            continue
        if has[other]:
            root.set(name, repr(length_px(root.get(other)) * ratio))
        else:
            root.set(name, repr(box[2] if name == "width" else box[3]))


def physical_m(text):
    """A length with a physical unit in metres, or None."""
    match = PHYSICAL_LENGTH.match(text or "")
    return float(match[1]) * UNIT_M[match[2]] if match else None


def metres_per_pixel(root_attributes, width_m, height_m, width_px, height_px):
    """Scale of the drawing: stated, physical units, or the longer side is one metre."""
    stated = root_attributes.get("data-page-width-m")
    if stated is not None:
        try:
            width_m = float(stated)
        except ValueError:
            width_m = 0.0
        if not 0.0 < width_m < 1e6:
            raise DrawingError(f"data-page-width-m must be a length in metres, is {stated!r}")
    if width_m:
        return width_m / width_px
    return height_m / height_px if height_m else 1.0 / max(width_px, height_px)


def collect(group, chain, shapes, by_id):
    """Lists the shapes below a group in drawing order."""
    for child in group:
        own = child.values.get("attributes", {})
        if isinstance(child, Shape):
            shape = DrawnShape(child, chain + [own])
            shapes.append(shape)
            if own.get("id"):
                by_id.setdefault(own["id"], shape)
        elif isinstance(child, Group):
            collect(child, chain + [own], shapes, by_id)


def read_drawing(path):
    """Parses a drawing.

    Args:
        path: an .svg or .svgz file.
    Returns:
        A Drawing.
    Raises:
        DrawingError: unreadable, not an SVG, or no page size.
    """
    root = load_tree(path)
    width_m, height_m = physical_m(root.get("width")), physical_m(root.get("height"))
    state_page_size(root)
    preparer = Preparer(root)
    preparer.keep_originals()
    notices = preparer.run()
    ET.register_namespace("", SVG_NS[1:-1])
    try:
        page = SVG.parse(io.BytesIO(ET.tostring(root)), reify=False, ppi=PIXELS_PER_INCH,
                         parse_display_none=True)
        width_px, height_px = float(page.width), float(page.height)
        to_page = Matrix(page.viewbox_transform)
    except Exception as error:  # svgelements raises many kinds on malformed values
        raise DrawingError(f"cannot understand {path}: {error!r}") from error
    if not (0.0 < width_px < 1e9 and 0.0 < height_px < 1e9):
        raise DrawingError(f"the page is empty or endless: {width_px} x {height_px} px")
    attributes = page.values.get("attributes", {})
    shapes, by_id = [], {}
    collect(page, [attributes], shapes, by_id)
    scale = metres_per_pixel(attributes, width_m, height_m, width_px, height_px)
    return Drawing(width_px, height_px, scale, to_page, attributes, shapes, by_id, notices)
