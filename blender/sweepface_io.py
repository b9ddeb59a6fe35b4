"""Sweepface in Blender: opens and saves .sweep faces, and moves shape keys by Newton's law, springs and captures.

An add-on in one file: Edit > Preferences > Add-ons > Install... It runs the tool `sweepface`, from PATH unless its
preferences say where it is. See docs/blender.md.
"""

import json
import os
import re
import struct
import subprocess
import tempfile
import time
from contextlib import contextmanager, nullcontext
from itertools import dropwhile, takewhile

import bpy
import numpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ExportHelper, ImportHelper, axis_conversion

bl_info = {
    "name": "Sweepface",
    "description": "Opens and saves .sweep faces; moves shape keys by Newton's law, springs and captures",
    "author": "The Sweepface authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "File > Import, File > Export; 3D View > Sidebar > Sweepface",
    "category": "Import-Export",
}

# Faces have y up, as OBJ and glTF do; Blender has z up.
UPRIGHT = axis_conversion(from_forward="-Z", from_up="Y").to_4x4()
NEAREST = 0.02  # frames; Blender treats keys nearer than this as one
STILL = 0.01  # how far a weight may be from where it rests without a warning
NO_CONSOLE = getattr(subprocess, "CREATE_NO_WINDOW", 0)  # which Windows would open and close again
SOURCE = "sweepface_file"  # the property of an object that names the file of the face it shows,
TARGETS = "sweepface_targets"  # and a JSON of the face's targets by the names of the shape keys


# ---- The tool ----


class Preferences(bpy.types.AddonPreferences):
    bl_idname = __name__

    tool: StringProperty(name="Tool", description="Where the program sweepface is", default="sweepface", subtype="FILE_PATH")

    def draw(self, _context):
        self.layout.prop(self, "tool")


def run_tool(operator, *arguments):
    """Runs the tool, yielding its process meanwhile, and reports its warnings; returns what it printed.

    Raises its error message if it fails.
    """
    if operator.is_cancelled:
        raise RuntimeError("Cancelled")
    addon = bpy.context.preferences.addons.get(__name__)
    tool = bpy.path.abspath(addon.preferences.tool) if addon else "sweepface"
    with tempfile.TemporaryDirectory() as folder:  # as nobody reads all the time, pipes could fill up
        printed, told = os.path.join(folder, "printed"), os.path.join(folder, "told")
        try:
            with open(printed, "wb") as stdout, open(told, "wb") as stderr:
                process = subprocess.Popen([tool, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=stdout,
                                           stderr=stderr, creationflags=NO_CONSOLE,
                                           env={**os.environ, "SWEEPFACE_PROGRESS": "1"})
        except OSError as error:
            raise RuntimeError(f"Cannot run {tool} ({error.strerror}); say in the add-on's preferences "
                               "where it is.") from error
        try:
            while process.returncode is None:
                operator.progress = told_by_tool(told)[1]
                yield process
                process.poll()
        finally:
            end(process)
        said, _ = told_by_tool(told)
        if process.returncode:
            raise RuntimeError(" ".join(said) or f"{tool} ended with {process.returncode}.")
        for line in said:
            if "--head on" not in line:  # advises an option that the add-on does not have
                operator.report({"WARNING"}, line.removeprefix("warning: "))
        with open(printed, encoding="utf-8", errors="replace") as file:
            return file.read()


def told_by_tool(path):
    """The messages among what the tool tells, and how far it says it is, such as "42 % fitting"."""
    with open(path, encoding="utf-8", errors="replace") as file:
        lines = [line.removeprefix("sweepface: ") for line in file.read().splitlines() if line]
    progress = [line for line in lines if re.match(r"\d+ % ", line)]
    return [line for line in lines if line not in progress], (progress or [""])[-1]


def end(process):
    """Ends a process of the tool if it still runs."""
    process.terminate()
    try:
        process.wait(3)  # the tool takes up to two seconds to stop; Windows ends it at once
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def path_of(operator):
    """The file that the user chose."""
    return os.path.abspath(bpy.path.abspath(operator.filepath))


WAITING = []  # the operators that wait for the tool while Blender goes on


def tell_waiting():
    """Shows in the status bar how far the tool is, and for how long operators have been waiting."""
    now = time.monotonic()
    texts = [f"{each.bl_label}: {each.progress or 'running'}, {now - each.began:.0f} s" for each in WAITING]
    for workspace in bpy.data.workspaces:  # the user may switch to another
        workspace.status_text_set(", ".join(texts) + " (Esc cancels)" if texts else None)


@contextmanager
def waiting(operator, context):
    """Has Blender call an operator from time to time, and shows that it waits."""
    operator.began = time.monotonic()
    timer = context.window_manager.event_timer_add(0.1, window=context.window)
    WAITING.append(operator)
    tell_waiting()
    try:
        yield
    finally:
        WAITING.remove(operator)
        tell_waiting()
        context.window_manager.event_timer_remove(timer)


class ToolOperator:
    """An operator that runs the tool and reports errors as sentences.

    If the user starts it, Blender goes on while the tool runs; scripts wait for the result. `work` is
    a generator that yields while the tool runs. Meanwhile it may keep names, but no data of Blender:
    the user may change, delete or undo anything.
    """

    bl_options = {"REGISTER", "UNDO"}
    steps, is_cancelled, is_done, progress = None, False, False, ""

    def execute(self, context):
        call = self.options
        is_redone = call.is_repeat or call.is_repeat_last  # which Blender does at once or not at all
        is_watched = call.is_invoke and not is_redone and not bpy.app.background
        self.is_cancelled, self.steps = False, self.work_in_folder(context, is_watched)
        result = self.step()
        if is_watched and result == {"RUNNING_MODAL"}:
            context.window_manager.modal_handler_add(self)
            return result
        while result == {"RUNNING_MODAL"}:
            self.process.wait()
            result = self.step()
        return result

    def work_in_folder(self, context, is_watched):
        shown = waiting(self, context) if is_watched else nullcontext()
        with tempfile.TemporaryDirectory() as folder, shown:
            yield from self.work(context, folder)

    def step(self):
        """Goes on with the work if the tool has ended."""
        try:
            self.process = next(self.steps)
        except StopIteration:
            return {"FINISHED"}
        except (OSError, RuntimeError) as error:
            level, text = ("INFO", "Cancelled") if self.is_cancelled else ("ERROR", str(error))
            self.report({level}, text)
            return {"CANCELLED"}
        return {"RUNNING_MODAL"}

    def modal(self, _context, event):
        if self.is_done:
            # Blender crashes if its undo step falls into the stroke of a brush. Then only timers get here.
            may_finish = event.type == "MOUSEMOVE" or event.value == "PRESS"
            return {"FINISHED", "PASS_THROUGH"} if may_finish else {"PASS_THROUGH"}
        if event.type == "ESC" and event.value == "PRESS" and not self.is_cancelled:
            self.is_cancelled = True
            self.process.terminate()
            return {"RUNNING_MODAL"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        tell_waiting()
        result = self.step()
        self.is_done = result == {"FINISHED"}
        return {"PASS_THROUGH"} if self.is_done else result

    def cancel(self, _context):
        """Called when Blender quits or opens a file, or the user chooses none."""
        if self.steps:
            self.steps.close()


# ---- Meshes as the tool writes and reads them ----


def numbers_of(lines, key):
    """The numbers [N x k] in the lines that begin with a key."""
    chosen = [line[len(key):] for line in lines if line.startswith(key + " ")]
    return numpy.fromstring(" ".join(chosen), sep=" ").reshape(len(chosen), -1) if chosen else numpy.empty((0, 3))


def places_in(path):
    """The vertices [N x 3] of an OBJ that the tool wrote, which are in consecutive lines."""
    is_vertex = lambda line: line.startswith("v ")
    with open(path, encoding="utf-8", errors="surrogateescape") as file:
        vertices = takewhile(is_vertex, dropwhile(lambda line: not is_vertex(line), file))
        return numpy.fromstring("".join(line[1:] for line in vertices), sep=" ").reshape(-1, 3)


def read_lines(path):
    with open(path, encoding="utf-8", errors="surrogateescape") as file:
        return file.read().splitlines()


def without_repeats(corners):
    """The corners of a face without those at the vertex of the one before: Blender crashes when it edits a face that
    has a vertex twice. Empty if there are fewer than three then, or the face comes back to a vertex."""
    kept = [corner for k, corner in enumerate(corners) if corner[0] != corners[k - 1][0]]
    return kept if 3 <= len(kept) == len({corner[0] for corner in kept}) else []


def new_mesh(name, lines):
    """A mesh from an OBJ that the tool wrote, with its polygons, texture coordinates and materials."""
    mesh = bpy.data.meshes.new(name)
    faces, materials, coordinates = [], [], []
    slots, current = {}, 0
    for line in lines:
        if line.startswith("usemtl "):
            current = slots.setdefault(line[len("usemtl "):], len(slots))
        elif line.startswith("f "):
            corners = without_repeats([corner.split("/") for corner in line.split()[1:]])
            if not corners:
                continue
            faces.append([int(corner[0]) - 1 for corner in corners])
            coordinates += [int(corner[1] or 0) - 1 if len(corner) > 1 else -1 for corner in corners]
            materials.append(current)
    for material in slots:
        mesh.materials.append(bpy.data.materials.get(material) or bpy.data.materials.new(material))
    mesh.from_pydata(numbers_of(lines, "v").tolist(), [], faces)
    mesh.polygons.foreach_set("material_index", materials)
    mesh.polygons.foreach_set("use_smooth", [True] * len(faces))
    if max(coordinates, default=-1) >= 0:
        places = numpy.vstack([numbers_of(lines, "vt")[:, :2], [[0, 0]]])  # -1, a corner without one, is the last: 0
        mesh.uv_layers.new(name="UVMap").data.foreach_set("uv", places[coordinates].ravel())
    mesh.update()
    return mesh


IS_WINDOWS = os.name == "nt"
FORBIDDEN = r"""[/\\:*?"<>|\x00-\x1f]""" if IS_WINDOWS else "/"  # in the names of files
DEVICE = r"(?i)(con|prn|aux|nul|com\d|lpt\d)(\.|$)" if IS_WINDOWS else r"(?!)"


def file_of(target):
    """The name that the tool gives the mesh file of a target."""
    name = re.sub(FORBIDDEN, "_", target)
    name = "_" + name[1:] if name.startswith(".") else name
    return ("_" if re.match(DEVICE, name) else "") + name + ".obj"


def add_keys(shown, folder, targets):
    """Adds shape keys to an object, from the meshes of a folder. Blender may change their names."""
    shown.shape_key_add(name="Basis", from_mix=False)
    names = {}
    for target in targets:
        key = shown.shape_key_add(name=target, from_mix=False)
        key.data.foreach_set("co", places_in(os.path.join(folder, file_of(target))).ravel())
        names[key.name] = target
    shown[TARGETS] = json.dumps(names)


def keys_of(shown):
    """The shape keys of a face, by the names of its targets."""
    names = json.loads(shown.get(TARGETS, "{}"))
    return {names[key.name]: key for key in shown.data.shape_keys.key_blocks if key.name in names}


def places_of(points):
    """The positions [N x 3] of vertices, or of the points of a shape key."""
    places = numpy.empty(3 * len(points), dtype=numpy.float32)
    points.foreach_get("co", places)
    return places.reshape(-1, 3).astype(numpy.float64)


def shapes_of(shown):
    """The neutral, and by name what each shape key makes of it at value 1: [N x 3] each, in the object's space."""
    mesh = shown.data
    if not mesh.shape_keys:
        return places_of(mesh.vertices), {}
    if not mesh.shape_keys.use_relative:
        raise RuntimeError(f"The shape keys of {shown.name} are absolute; make them relative.")
    neutral, shapes = places_of(mesh.shape_keys.reference_key.data), {}
    for key in mesh.shape_keys.key_blocks:
        if key == mesh.shape_keys.reference_key:
            continue
        offsets = places_of(key.data) - places_of(key.relative_key.data)
        if group := shown.vertex_groups.get(key.vertex_group):
            shares = [next((g.weight for g in vertex.groups if g.group == group.index), 0) for vertex in mesh.vertices]
            offsets *= numpy.array(shares)[:, None]
        shapes[key.name] = neutral + offsets
    return neutral, shapes


def faces_text(mesh, turn_over):
    """The part of an OBJ after its vertices; `turn_over` if the object is mirrored."""
    parts, current = [], None
    layer = mesh.uv_layers.active
    if layer:
        corners = numpy.empty(2 * len(mesh.loops), dtype=numpy.float32)
        layer.data.foreach_get("uv", corners)
        distinct, numbers = numpy.unique(corners.reshape(-1, 2), axis=0, return_inverse=True)
        numbers = numbers.ravel()
        parts += ["vt %.9g %.9g" % tuple(place) for place in distinct]
    for polygon in mesh.polygons:
        if mesh.materials and polygon.material_index != current:
            current = polygon.material_index
            material = mesh.materials[min(current, len(mesh.materials) - 1)]
            name = " ".join(material.name.split()).rstrip("\\") if material else ""  # or it would continue the line
            parts.append(f"usemtl {name or 'none'}")
        loops = list(polygon.loop_indices)
        if turn_over:
            loops.reverse()
        vertices = [mesh.loops[loop].vertex_index + 1 for loop in loops]
        parts.append("f " + " ".join(f"{v}/{numbers[loop] + 1}" if layer else f"{v}" for v, loop in zip(vertices, loops)))
    return "\n".join(parts) + "\n"


def write_obj(path, places, faces, to_world):
    """Writes an OBJ of `places` [N x 3], which are in the object's space."""
    turned = places @ numpy.array(to_world)[:3, :3].T + numpy.array(to_world)[:3, 3]
    with open(path, "w", encoding="utf-8", errors="surrogateescape") as file:
        file.writelines("v %.9g %.9g %.9g\n" % tuple(place) for place in turned)
        file.write(faces)


def write_face(shown, neutral, folder):
    """Writes an object as the OBJ `neutral`, and its shape keys into a folder; returns their OBJs by their names."""
    places, shapes = shapes_of(shown)
    to_world = UPRIGHT.inverted() @ shown.matrix_world
    faces = faces_text(shown.data, to_world.determinant() < 0)
    write_obj(neutral, places, faces, to_world)
    os.mkdir(folder)
    targets = {}
    for name, shape in shapes.items():
        is_taken = IS_WINDOWS and name.lower() in map(str.lower, targets)
        if is_taken or "\\" in name or file_of(name) != name + ".obj":
            raise RuntimeError(f"The shape key '{name}' cannot be the name of a target here; rename it.")
        targets[name] = os.path.join(folder, name + ".obj")
        write_obj(targets[name], shape, faces, to_world)
    return targets


def levels_of(shown):
    """How often an object is shown subdivided; at most twice, as more adds vertices to the same surface."""
    levels = [modifier.levels for modifier in shown.modifiers if modifier.type == "SUBSURF" and modifier.show_viewport
              and modifier.subdivision_type == "CATMULL_CLARK"]
    return min(2, sum(levels))


@contextmanager
def objects_mode(shown):
    """Switches to object mode for a while: in edit mode Blender keeps an object's mesh elsewhere."""
    mode = shown.mode
    if mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    try:
        yield
    finally:
        if mode != "OBJECT":
            bpy.ops.object.mode_set(mode=mode)


# ---- Import and export ----


class ImportSweep(ToolOperator, bpy.types.Operator, ImportHelper):
    """Open a face as a mesh with a shape key for each of its targets"""

    bl_idname = "import_scene.sweep"
    bl_label = "Import .sweep"
    filename_ext = ".sweep"

    filter_glob: StringProperty(default="*.sweep", options={"HIDDEN"})
    lod: IntProperty(name="Level of detail", description="0: the source's own polygons; N: every edge cut into N", default=0,
                     min=0, max=16)

    def work(self, context, folder):
        if context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        path, meshes = path_of(self), os.path.join(folder, "face")
        names = json.loads((yield from run_tool(self, "info", path, "--json")))["targets"]
        detail = ["--lod", self.lod] if self.lod else []
        yield from run_tool(self, "export", path, "-o", meshes, "--quiet", *detail)
        name = os.path.splitext(os.path.basename(path))[0]
        shown = bpy.data.objects.new(name, new_mesh(name, read_lines(os.path.join(meshes, "neutral.obj"))))
        context.collection.objects.link(shown)
        if names:
            add_keys(shown, os.path.join(meshes, "expressions"), names)
        shown.matrix_world = UPRIGHT
        shown[SOURCE] = path
        if context.mode != "OBJECT":
            return  # the user began to edit something else, which stays active
        for other in context.selected_objects:
            other.select_set(False)
        shown.select_set(True)
        context.view_layer.objects.active = shown


class ExportSweep(ToolOperator, bpy.types.Operator, ExportHelper):
    """Save the active mesh and its shape keys as a face"""

    bl_idname = "export_scene.sweep"
    bl_label = "Export .sweep"
    bl_options = {"UNDO"}  # not REGISTER, as Blender would stand still when the last operation is adjusted
    filename_ext = ".sweep"

    filter_glob: StringProperty(default="*.sweep", options={"HIDDEN"})
    tolerance: FloatProperty(name="Tolerance", description="How far any vertex may be off, in Blender's units; 0: 0.02 % of "
                             "the neutral's diagonal", default=0, min=0, precision=5)
    pack: BoolProperty(name="Pack", description="Make the file small: a hundredth as large, but slower to make", default=True)
    subdivide: IntProperty(name="Subdivide", description="The mesh is the cage of a subdivision surface: save that, with "
                           "every edge cut into 2 to the power of N; 0: save the mesh as it is", default=0, min=0, max=5)

    @classmethod
    def poll(cls, context):
        return context.active_object is not None and context.active_object.type == "MESH"

    def invoke(self, context, event):
        self.subdivide = levels_of(context.active_object)
        return super().invoke(context, event)

    def work(self, context, folder):
        shown, path = context.active_object, path_of(self)
        name, neutral = shown.name, os.path.join(folder, "neutral.obj")
        with objects_mode(shown):
            targets = write_face(shown, neutral, os.path.join(folder, "expressions"))
        options = (["--pack"] if self.pack else []) + (["--tolerance", self.tolerance] if self.tolerance else [])
        options += ["--subdivide", self.subdivide] if self.subdivide else []
        said = yield from run_tool(self, "convert", neutral, *targets.values(), "-o", path, *options)
        if shown := bpy.data.objects.get(name):
            shown[SOURCE] = path
            shown[TARGETS] = json.dumps({target: target for target in targets})
        self.report({"INFO"}, said.splitlines()[-1])


# ---- Motion ----


class Animation:
    """The weights in a GLB that the tool wrote: its last animation, after any of the face's own scene.

    `tracks` has by target its times [N] and keys [N x 3]: slope before, value, slope after; or [N x 1], values alone.
    """

    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        length = struct.unpack_from("<I", data, 12)[0]
        self.document, self.binary = json.loads(data[20:20 + length]), data[28 + length:]
        animation, self.tracks = self.document["animations"][-1], {}
        for channel in animation["channels"]:
            if channel["target"]["path"] == "weights":
                self.read(channel["target"]["node"], animation["samplers"][channel["sampler"]])
        self.seconds = max(times[-1] for times, _ in self.tracks.values())

    def read(self, node, sampler):
        mesh = self.document["meshes"][self.document["nodes"][node]["mesh"]]
        names, times = mesh["extras"]["targetNames"], self.floats(sampler["input"])
        values = self.floats(sampler["output"]).reshape(len(times), -1, len(names))
        for k, name in enumerate(names):
            self.tracks.setdefault(name, (times, values[:, :, k]))

    def floats(self, number):
        accessor = self.document["accessors"][number]
        start = self.document["bufferViews"][accessor["bufferView"]].get("byteOffset", 0) + accessor.get("byteOffset", 0)
        return numpy.frombuffer(self.binary, dtype="<f4", count=accessor["count"], offset=start).astype(numpy.float64)


def curves_of(keys):
    """The F-curves of shape keys, or None. Since Blender 4.4 actions have layers, and slots for what they animate."""
    data = keys.animation_data
    if not data or not data.action:
        return None
    slot = getattr(data, "action_slot", None)
    if slot is None:
        return getattr(data.action, "fcurves", None)
    bags = (strip.channelbag(slot) for layer in data.action.layers for strip in layer.strips)
    return next((bag.fcurves for bag in bags if bag), None)


def curve_of(key):
    """The F-curve of a shape key's value, or None."""
    curves = curves_of(key.id_data)
    return curves.find(key.path_from_id("value")) if curves else None


def driver_of(key):
    data = key.id_data.animation_data
    return data and data.drivers.find(key.path_from_id("value"))


# The fields of an F-curve's key: NUMBERS with their counts, which are read and written for all keys at once, and WORDS.
NUMBERS = {"co": 2, "handle_left": 2, "handle_right": 2, "amplitude": 1, "back": 1, "period": 1}
WORDS = ("interpolation", "easing", "handle_left_type", "handle_right_type")


def key_at(frame, value, interpolation):
    """A key whose handles coincide with it."""
    place = numpy.array([frame, value])
    return {"co": place, "handle_left": place.copy(), "handle_right": place.copy(), "amplitude": 0.8, "back": 1.70158, "period": 4.1,
            "interpolation": interpolation, "easing": "AUTO", "handle_left_type": "FREE", "handle_right_type": "FREE"}


def keys_in(curve):
    """The keys of an F-curve in order, each a dictionary of NUMBERS and WORDS."""
    points, columns = curve.keyframe_points, {}
    for field, size in NUMBERS.items():
        columns[field] = numpy.empty(size * len(points), dtype=numpy.float32)
        points.foreach_get(field, columns[field])
        if size == 2:
            columns[field] = columns[field].astype(float).reshape(-1, 2)
    return [{field: column[k] for field, column in columns.items()} | {word: getattr(point, word) for word in WORDS}
            for k, point in enumerate(points)]


def set_keys(curve, keys):
    points = curve.keyframe_points
    for _ in range(len(points) - len(keys)):
        points.remove(points[-1], fast=True)
    points.add(max(0, len(keys) - len(points)))
    for field in NUMBERS:
        points.foreach_set(field, numpy.array([key[field] for key in keys]).ravel())
    for point, key in zip(points, keys):
        for word in WORDS:
            setattr(point, word, key[word])
    curve.update()


def split(start, end, frame):
    """Splits the Bezier between two keys: changes the first one's handle, and returns a key that keeps its shape."""
    corners = numpy.array([start["co"], start["handle_right"], end["handle_left"], end["co"]])
    low, high = 0.0, 1.0
    for _ in range(50):
        t = (low + high) / 2
        left = [corners]  # de Casteljau
        while len(left[-1]) > 1:
            left.append(left[-1][:-1] + t * (left[-1][1:] - left[-1][:-1]))
        low, high = (t, high) if left[-1][0, 0] < frame else (low, t)
    start["handle_right"] = left[1][0]
    key = key_at(frame, left[3][0, 1], "BEZIER")
    key["handle_left"] = left[2][0]
    return key


def keys_until(curve, frame):
    """The keys of an F-curve before a frame, and a key there that keeps the curve up to it."""
    keys, value = keys_in(curve), curve.evaluate(frame)
    before, behind = ([key for key in keys if (key["co"][0] < frame - NEAREST / 2) == side] for side in (True, False))
    if not before:
        return [key_at(frame, value, "CONSTANT")]
    last = before[-1]
    last["handle_left_type"] = last["handle_right_type"] = "FREE"
    if not behind:
        last["interpolation"] = "CONSTANT" if curve.extrapolation == "CONSTANT" else "LINEAR"
        return [*before, key_at(frame, value, "CONSTANT")]
    if last["interpolation"] == "BEZIER":
        return [*before, split(last, behind[0], frame)]
    if last["interpolation"] not in ("CONSTANT", "LINEAR"):  # an easing, which cannot be split
        last["interpolation"] = "LINEAR"
        frames = numpy.arange(numpy.floor(last["co"][0]) + 1, frame - NEAREST / 2)
        before += [key_at(at, curve.evaluate(at), "LINEAR") for at in frames]
    return [*before, key_at(frame, value, "LINEAR")]


def motion_keys(times, values, first, rate):
    """Keys of an F-curve, from `values` [N x 3] with slopes or [N x 1]. Keys nearer than NEAREST become a jump."""
    has_slopes = values.shape[1] == 3

    def made(k):
        key = key_at(first + times[k] * rate, values[k, values.shape[1] // 2], "BEZIER" if has_slopes else "LINEAR")
        return key | {"slopes": list(values[k, [0, -1]] / rate) if has_slopes else [0, 0]}

    keys, k = [], 0
    while k < len(times):
        key, last = made(k), k
        while last + 1 < len(times) and (times[last + 1] - times[k]) * rate < NEAREST:
            last += 1
        if last > k:
            later = made(last)
            has_room = not keys or keys[-1]["co"][0] < later["co"][0] - 2 * NEAREST
            if has_room and abs(later["co"][1] - key["co"][1]) > 0.01:
                key["co"][0] = later["co"][0] - NEAREST if keys else key["co"][0]
                later["co"][0] = max(later["co"][0], key["co"][0] + NEAREST)
                key["interpolation"] = "LINEAR"
                keys.append(key)
            else:
                later["slopes"][0] = key["slopes"][0]
            key = later
        if not keys or key["co"][0] >= keys[-1]["co"][0] + NEAREST / 2:
            keys.append(key)
        k = last + 1
    for key, following in zip(keys, keys[1:]):
        # A Hermite cubic is a Bezier cubic whose handles are a third of the way to the next key.
        third = (following["co"][0] - key["co"][0]) / 3
        key["handle_right"] = key["co"] + [third, third * key["slopes"][1]]
        following["handle_left"] = following["co"] - [third, third * following["slopes"][0]]
    return keys


def show(key, times, values, first, rate):
    """Puts a motion into the F-curve of a shape key, in place of the keys during that time."""
    motion = motion_keys(times, values, first, rate)
    start, end = motion[0]["co"][0], motion[-1]["co"][0]
    curve, before = curve_of(key), []
    if not curve:
        key.keyframe_insert("value", frame=start)
        curve = curve_of(key)
    elif abs(curve.evaluate(start) - motion[0]["co"][1]) > 1e-6:  # a jump
        before = keys_until(curve, start - NEAREST)
        before[-1]["interpolation"] = "CONSTANT"
    else:
        *before, same = keys_until(curve, start)
        motion[0]["handle_left"] = same["handle_left"]
    behind = [other for other in keys_in(curve) if other["co"][0] > end + NEAREST / 2]
    if behind:
        behind[0]["handle_left_type"] = behind[0]["handle_right_type"] = "FREE"
    set_keys(curve, [*before, *motion, *behind])
    heights = [place[1] for each in motion for place in (each["co"], each["handle_left"], each["handle_right"])]
    key.slider_min, key.slider_max = max(min(key.slider_min, *heights), -10), min(max(key.slider_max, *heights), 10)


def check_movable(shown):
    """Refuses shape keys that are linked from another file, or that their keyframes alone do not move."""
    data = shown.data.shape_keys.animation_data
    if shown.library or shown.data.library:
        raise RuntimeError(f"{shown.name} is linked from another file; make it local.")
    if data and (data.use_tweak_mode or any(track.strips and not track.mute for track in data.nla_tracks)):
        raise RuntimeError(f"The shape keys of {shown.name} are moved by NLA strips; bake or mute them.")
    for name, key in keys_of(shown).items():
        if not (curve := curve_of(key)):
            continue
        if curve.lock or (curve.group and curve.group.lock):
            raise RuntimeError(f"The F-curve of {name} is locked; unlock it.")
        if curve.modifiers:
            raise RuntimeError(f"The F-curve of {name} has modifiers; apply or remove them.")


def is_face(shown):
    """Whether an object was opened from a face's file, or saved to one."""
    return bool(shown and shown.type == "MESH" and shown.data.shape_keys and shown.get(SOURCE))


def rate_of(scene):
    """Frames a second."""
    return scene.render.fps / scene.render.fps_base


class MotionOperator(ToolOperator):
    """An operator that moves the shape keys of a face."""

    @classmethod
    def poll(cls, context):
        return is_face(context.active_object)

    def play(self, context, folder, first, *options, end=None):
        """Has the tool animate the face, and keys the result from a frame on; returns its last frame.

        `end` has the weights at which a spring is stopped.
        """
        shown, rate = context.active_object, rate_of(context.scene)
        name, path = shown.name, os.path.join(folder, "take.glb")
        check_movable(shown)
        yield from run_tool(self, "animate", shown[SOURCE], "-o", path, *options)
        shown = bpy.data.objects.get(name)
        if not is_face(shown):
            raise RuntimeError(f"{name} was removed or renamed in the meantime; try again.")
        check_movable(shown)
        animation, keys = Animation(path), keys_of(shown)
        if any("@" in name and name not in keys and name.split("@")[0] in animation.tracks for name in animation.tracks):
            raise RuntimeError("Shape keys cannot show the regions of a timeline; leave them out of it.")
        moving = {name: track for name, track in animation.tracks.items() if track[1][:, track[1].shape[1] // 2].any()}
        lacking = [name for name in moving if name not in keys]
        if lacking:
            self.report({"WARNING"}, f"There are no shape keys {', '.join(lacking)}.")
        driven = [name for name in moving if name in keys and driver_of(keys[name])]
        if driven:
            self.report({"WARNING"}, f"Drivers move the shape keys {', '.join(driven)}, whatever their keys say.")
        missed = {}
        for name in animation.tracks.keys() & (end or {}).keys():
            values = animation.tracks[name][1]
            last = values[-1:, values.shape[1] // 2]
            missed[name] = abs(last[0] - end[name])
            last[:] = end[name]
        worst = max(missed, key=missed.get, default=None)
        if worst and missed[worst] > STILL:
            self.report({"WARNING"}, f"The spring is {missed[worst]:.2g} away from {worst} when the time is over; give it more seconds or "
                                     "another damping.")
        for name, (times, values) in animation.tracks.items():
            key = keys.get(name)
            if key and (name in moving or curve_of(key) or key.value):  # others stay at rest as they are
                show(key, times, values, first, rate)
        return first + animation.seconds * rate


class MoveToPose(MotionOperator, bpy.types.Operator):
    """Move to the pose that the sliders show, so that the face arrives there at the current frame"""

    bl_idname = "object.sweepface_move"
    bl_label = "Move to This Pose"

    law: EnumProperty(name="Law", default="accelerate-brake", items=[
        ("newton", "Newton", "A constant force from rest, which ends at full speed"),
        ("brake", "Brake", "Begins at full speed and comes to rest"),
        ("accelerate-brake", "Accelerate, brake", "A force forwards, then one backwards"),
        ("linear-force", "Linear force", "A force that turns evenly from forwards to backwards"),
        ("spring", "Spring", "A damped spring, which may overshoot"),
        ("bounce", "Bounce", "Falls onto the pose and bounces off"),
        ("linear", "Linear", "At an even speed")])
    seconds: FloatProperty(name="Seconds", description="How long it takes; a spring is stopped then", default=0.5, min=0.01, max=3600)
    frequency: FloatProperty(name="Frequency", description="Of a spring: swings a second", default=2, min=0.01, max=100)
    damping: FloatProperty(name="Damping", description="Of a spring: below 1 it overshoots", default=0.5, min=0, max=10)
    restitution: FloatProperty(name="Restitution", description="Of a bounce: the part of the speed that is left", default=0.4,
                               min=0, max=0.99)

    pose: StringProperty(options={"HIDDEN", "SKIP_SAVE"})  # of the sliders, as JSON: on redo they have moved

    def invoke(self, context, _event):
        return context.window_manager.invoke_props_dialog(self)

    def draw(self, _context):
        names = {"spring": ["frequency", "damping"], "bounce": ["restitution"]}.get(self.law, [])
        for name in ["law", "seconds", *names]:
            self.layout.prop(self, name)

    def work(self, context, folder):
        shown, scene = context.active_object, context.scene
        check_movable(shown)
        first = scene.frame_current_final - self.seconds * rate_of(scene)
        keys, blocks = keys_of(shown), shown.data.shape_keys
        others = [key.name for key in blocks.key_blocks if key.value and key != blocks.reference_key and key not in keys.values()]
        if others:
            raise RuntimeError(f"The file of the face has no targets for {', '.join(others)}; save the face again.")
        self.pose = self.pose or json.dumps({name: key.value for name, key in keys.items()})
        end = json.loads(self.pose)
        start = {name: curve.evaluate(first) if (curve := curve_of(key)) else 0 for name, key in keys.items()}
        if start == end:
            raise RuntimeError("The face is in this pose already; set the sliders to another.")
        for name in start:
            if (start[name] or end[name]) and ("," in name or name != name.strip()):
                raise RuntimeError(f"The name of the shape key '{name}' has a comma or a blank at an end; rename it, and save the "
                                   "face again.")
        options = ["--law", self.law, "--seconds", self.seconds]
        if self.law == "spring":
            options += ["--frequency", self.frequency, "--damping", self.damping]
        if self.law == "bounce":
            options += ["--restitution", self.restitution]
        told = lambda weights: ",".join(f"{name}={weight:.9g}" for name, weight in weights.items() if start[name] or end[name])
        yield from self.play(context, folder, first, "--from", told(start), "--to", told(end), *options,
                             end=end if self.law == "spring" else None)


class PlayClip(MotionOperator, bpy.types.Operator, ImportHelper):
    """Play a capture or a timeline from the current frame on"""

    bl_idname = "object.sweepface_clip"
    bl_label = "Play a Clip"

    filter_glob: StringProperty(default="*.csv;*.json;*.glb;*.gltf;*.vrm", options={"HIDDEN"})
    smooth: BoolProperty(name="Smooth", description="Take a tracker's noise out of it", default=False)
    names: StringProperty(name="Names", description="A .json that says which shape keys the clip's names drive where they are called "
                          "otherwise", subtype="FILE_PATH")
    combine: BoolProperty(name="Combine", description="Targets named A_B or A_50 follow A and B", default=False)

    def work(self, context, folder):
        options = (["--smooth"] if self.smooth else []) + (["--combine"] if self.combine else [])
        if self.names:
            options += ["--clip-names", bpy.path.abspath(self.names)]
        name, first = context.scene.name, context.scene.frame_current_final
        last = yield from self.play(context, folder, first, "--clip", path_of(self), *options)
        if scene := bpy.data.scenes.get(name):
            scene.frame_end = max(scene.frame_end, int(numpy.ceil(last)))


# ---- Where Blender shows them ----


class Panel(bpy.types.Panel):
    bl_idname = "VIEW3D_PT_sweepface"
    bl_label = "Sweepface"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Sweepface"

    def draw(self, context):
        if not is_face(context.active_object):
            self.layout.label(text="Open a .sweep face, or save one", icon="INFO")
            self.layout.operator(ImportSweep.bl_idname)
            self.layout.operator(ExportSweep.bl_idname)
            return
        self.layout.label(text=os.path.basename(context.active_object[SOURCE]))
        self.layout.operator(MoveToPose.bl_idname)
        self.layout.operator(PlayClip.bl_idname)


def draw_import(menu, _context):
    menu.layout.operator(ImportSweep.bl_idname, text="Sweepface (.sweep)")


def draw_export(menu, _context):
    menu.layout.operator(ExportSweep.bl_idname, text="Sweepface (.sweep)")


CLASSES = (Preferences, ImportSweep, ExportSweep, MoveToPose, PlayClip, Panel)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.TOPBAR_MT_file_import.append(draw_import)
    bpy.types.TOPBAR_MT_file_export.append(draw_export)


def unregister():
    for each in list(WAITING):
        each.cancel(bpy.context)
    bpy.types.TOPBAR_MT_file_import.remove(draw_import)
    bpy.types.TOPBAR_MT_file_export.remove(draw_export)
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
