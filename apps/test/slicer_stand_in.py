# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Stands in for the modules slicer, ctk and qt of 3D Slicer, outside of it.

Classes and functions have the names of slicer_names.json, which were read from the sources of 3D Slicer, CTK and Qt. An
unknown name, a wrong number of arguments or an unknown signal raises an error. All calls are recorded. VTK is the real
one. What methods do is written in BEHAVIOR, as far as the module needs it; the others do nothing.
"""

import contextlib
import json
import pathlib
import sys
import tempfile
import types

import vtk

NAMES = json.loads(pathlib.Path(__file__).with_name("slicer_names.json").read_text(encoding="utf-8"))
STATUS = {"Idle": 0, "Scheduled": 1, "Running": 2, "Cancelling": 4, "Cancelled": 8, "Completing": 16, "Completed": 32,
          "ErrorsMask": 64, "CompletedWithErrors": 96}  # fmt: skip
# What bases that no header of Slicer declares have: those of VTK, as the real ones, and views of CTK.
OUTSIDE = {"vtkObject": vtk.vtkObject}
STATIC = ("QTimer.singleShot",)
CALLS = []
LATER = []  # what was put off until the application has nothing else to do
BEHAVIOR = {}


def does(kind, name):
    """Decorator: what a method of a class, and of those derived from it, does."""

    def register(function):
        BEHAVIOR[kind, name] = function
        return function

    return register


def line_of(kind):
    """The class and its bases."""
    line = []
    while kind in NAMES["classes"]:
        line.append(kind)
        kind = NAMES["classes"][kind]["base"]
    return line + [kind]


class StandIn:
    """An object of a class of Slicer, CTK or Qt."""

    def __init__(self, kind, *arguments):
        line = line_of(kind)
        if len(line) == 1:
            raise AttributeError(f"no class {kind}")
        object.__setattr__(self, "kind", kind)
        object.__setattr__(self, "line", line)
        object.__setattr__(self, "state", {})
        object.__setattr__(self, "arguments", arguments)

    def declared(self, part):
        return {name for kind in self.line[:-1] for name in NAMES["classes"][kind][part]}

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        if name == "connect" and self.line[0][0] in "qcQ":
            return self.connect_signal
        if name in self.declared("properties") and f"{self.kind}.{name}" not in STATIC:
            return self.state.get(name, DEFAULTS.get((self.kind, name)))
        if name in self.declared("constants"):
            return STATUS.get(name, 1 << sorted(self.declared("constants")).index(name))
        for kind in self.line[:-1]:
            if name in NAMES["classes"][kind]["methods"]:
                return self.method(name, NAMES["classes"][kind]["methods"][name])
        outside = OUTSIDE.get(self.line[-1])
        if outside and hasattr(outside, name):
            return self.method(name, [0, 9])
        raise AttributeError(f"{self.kind} has no {name}")

    def __setattr__(self, name, value):
        if name not in self.declared("properties"):
            raise AttributeError(f"{self.kind} has no property {name}")
        CALLS.append(f"{self.kind}.{name} = {value!r}")
        self.state[name] = value

    def method(self, name, count):
        def call(*arguments):
            if not count[0] <= len(arguments) <= count[1]:
                raise TypeError(f"{self.kind}.{name} takes {count[0]} to {count[1]} arguments, not {len(arguments)}")
            CALLS.append(f"{self.kind}.{name}({', '.join(map(describe, arguments))})")
            for kind in self.line:
                if (kind, name) in BEHAVIOR:
                    return BEHAVIOR[kind, name](self, *arguments)
            return None

        return call

    def connect_signal(self, signal, receiver):
        if signal not in self.declared("signals"):
            raise AttributeError(f"{self.kind} has no signal {signal}")
        if not callable(receiver):
            raise TypeError(f"{self.kind}.{signal}: {receiver!r} cannot be called")
        CALLS.append(f"{self.kind}.connect({signal!r})")
        self.state.setdefault("receivers", {}).setdefault(signal, []).append(receiver)

    def emit(self, signal, *arguments):
        """For tests: what a user does."""
        for receiver in self.state["receivers"][signal]:
            receiver(*arguments)


# What properties are before they are set.
DEFAULTS = {
    ("QDoubleSpinBox", "value"): 0.0,
    ("qMRMLLayoutManager", "threeDViewCount"): 1,
    ("ctkRangeWidget", "minimumValue"): 0.0,
    ("ctkRangeWidget", "maximumValue"): 99.0,
    ("ctkRangeWidget", "maximum"): 99.0,
    ("qSlicerScriptedLoadableModule", "path"): "",
}


def describe(value):
    return value.state.get("name", value.kind) if isinstance(value, StandIn) else repr(value)


class StrictModule(types.ModuleType):
    """A module of which only some names are known."""

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        raise AttributeError(f"{self.__name__} has no {name}")


class ClassModule(StrictModule):
    """A module of classes with a prefix, whose constants can be used without an object."""

    def __init__(self, name, prefixes):
        super().__init__(name)
        self.prefixes = prefixes

    def __getattr__(self, name):
        if name == "Qt" or (name.startswith(self.prefixes) and name in NAMES["classes"]):
            return Kind(name)
        return super().__getattr__(name)


class Kind:
    """A class: makes objects, has constants."""

    def __init__(self, name):
        self.name = name

    def __call__(self, *arguments):
        CALLS.append(f"{self.name}({', '.join(map(describe, arguments))})")
        return StandIn(self.name, *arguments)

    def __getattr__(self, name):
        if name[:1].isupper() or f"{self.name}.{name}" in STATIC:
            return getattr(StandIn(self.name), name)
        raise AttributeError(f"{self.name} has no {name}")


def function(module, name, behavior=lambda *arguments, **named: None):
    """A function of Slicer's Python files, whose arguments are checked."""
    known = NAMES["functions"][module][name]

    def call(*arguments, **named):
        unknown = set(named) - set(known["arguments"][len(arguments) :])
        if unknown and not known["any"]:
            raise TypeError(f"{module}.{name} has no argument {unknown}")
        given = len(arguments) + len(named)
        if not known["required"] <= given or len(arguments) > len(known["arguments"]):
            raise TypeError(f"{module}.{name}: {given} arguments")
        CALLS.append(f"{module}.{name}({', '.join([*map(describe, arguments), *(f'{k}={describe(v)}' for k, v in named.items())])})")
        return behavior(*arguments, **named)

    return call


# --- what methods do


@does("vtkMRMLScene", "AddNewNodeByClass")
def add_node(scene, kind, name=""):
    node = StandIn(kind)
    scene.state.setdefault("nodes", []).append(node)
    node.state.update(name=name, id=f"{kind}{len(scene.state['nodes'])}")
    return node


@does("vtkMRMLScene", "RemoveNode")
def remove_node(scene, node):
    if not isinstance(node, StandIn):
        raise TypeError(f"RemoveNode({node!r})")
    scene.state.setdefault("nodes", [])
    scene.state["nodes"] = [other for other in scene.state["nodes"] if other is not node]


@does("vtkMRMLScene", "IsNodePresent")
def is_present(scene, node):
    return any(other is node for other in scene.state.get("nodes", []))


@does("vtkMRMLScene", "GetFirstNode")
def first_node(scene, name=None, kind=None, *_rest):
    fits = (node for node in scene.state.get("nodes", []) if node.state["name"] == name and kind in node.line)
    return next(fits, None)


@does("vtkMRMLNode", "GetName")
def get_name(node):
    return node.state["name"]


@does("vtkMRMLNode", "GetID")
def get_id(node):
    return node.state["id"]


@does("vtkMRMLDisplayableNode", "CreateDefaultDisplayNodes")
def create_display(node):
    node.state["display"] = StandIn({"vtkMRMLModelNode": "vtkMRMLModelDisplayNode"}.get(node.kind, "vtkMRMLLabelMapVolumeDisplayNode"))


@does("vtkMRMLDisplayableNode", "GetDisplayNode")
def get_display(node):
    return node.state.get("display")


@does("vtkMRMLModelNode", "GetPolyData")
def get_poly_data(node):
    return node.state.get("surface")


@does("vtkMRMLVolumeNode", "GetImageData")
def get_image_data(node):
    return node.state.get("image")


@does("vtkSlicerColorLogic", "AddDefaultColorLegendDisplayNode")
def add_legend(_logic, _node):
    return StandIn("vtkMRMLColorLegendDisplayNode")


@does("vtkSlicerCamerasModuleLogic", "GetViewActiveCameraNode")
def active_camera(_logic, _view):
    return StandIn("vtkMRMLCameraNode")


@does("qMRMLLayoutManager", "threeDWidget")
def three_d_widget(_layout, _number):
    return StandIn("qMRMLThreeDWidget")


@does("qMRMLThreeDWidget", "threeDView")
def three_d_view(_widget):
    return StandIn("qMRMLThreeDView")


@does("qMRMLThreeDView", "mrmlViewNode")
def view_node(_view):
    return StandIn("vtkMRMLViewNode")


@does("vtkSlicerSegmentationsModuleLogic", "ExportSegmentsToLabelmapNode")
def export_segments(_logic, segmentation, ids, labels, _reference):
    known = [ids.GetValue(k) for k in range(ids.GetNumberOfValues())]
    labels.state["file"] = segmentation.state.get("segments", {}).get(known[0])
    return labels.state["file"] is not None


@does("qMRMLNodeComboBox", "currentNode")
@does("qMRMLSegmentSelectorWidget", "currentNode")
def current_node(selector):
    return selector.state.get("node")


@does("qMRMLSegmentSelectorWidget", "currentSegmentID")
def current_segment(selector):
    return selector.state.get("segment", "")


@does("ctkRangeWidget", "setRange")
def set_range(widget, low, high):
    widget.state.update(minimum=low, maximum=high)


@does("ctkRangeWidget", "setValues")
def set_values(widget, low, high):
    widget.state.update(minimumValue=low, maximumValue=high)


@does("QTableView", "horizontalHeader")
def horizontal_header(_table):
    return StandIn("QHeaderView")


@does("QTableWidget", "setItem")
def set_item(table, row, column, item):
    table.state.setdefault("items", {})[row, column] = item.arguments[0]


@does("QTimer", "singleShot")
def put_off(_timer, _milliseconds, function):
    LATER.append(function)


def do_later():
    """For tests: the application has time."""
    while LATER:
        LATER.pop(0)()


@does("vtkObject", "AddObserver")
def add_observer(node, _event, callback):
    node.state.setdefault("observers", {})[len(node.state.get("observers", {}))] = callback
    return len(node.state["observers"]) - 1


@does("vtkObject", "RemoveObserver")
def remove_observer(node, tag):
    del node.state["observers"][tag]


@does("vtkMRMLCommandLineModuleNode", "GetStatus")
def get_status(node):
    return node.state.get("status", 0)


@does("vtkMRMLCommandLineModuleNode", "GetStatusString")
def get_status_string(node):
    return next(name for name, value in STATUS.items() if value == node.state.get("status", 0))


@does("vtkMRMLCommandLineModuleNode", "GetProgress")
def get_progress(node):
    return node.state.get("progress", 0)


@does("vtkMRMLCommandLineModuleNode", "GetErrorText")
def get_error_text(node):
    return node.state.get("errors", "")


@does("vtkMRMLCommandLineModuleNode", "Cancel")
def cancel(node):
    tell(node, status=STATUS["Cancelling"])


def tell(node, **state):
    """Changes the state of a command line module's node and tells its observers."""
    node.state.update(state)
    for callback in list(node.state.get("observers", {}).values()):
        callback(node, "ModifiedEvent")


# --- the modules


def make_base(name):
    """A base class of scripted modules, with the names of Slicer's."""
    known = {word.split(".")[1] for word in NAMES["functions"]["slicer.ScriptedLoadableModule"] if word.startswith(f"{name}.")}

    class Base:
        def __init__(self, parent=None):
            self.parent = parent
            self.layout = StandIn("QVBoxLayout")

        def __getattr__(self, word):
            if word in known:
                return lambda *arguments: None
            raise AttributeError(f"{name} has no {word}")

    Base.__name__ = name
    for word in ("setup", "cleanup"):
        if word in known:
            setattr(Base, word, lambda self: None)
    return Base


class ObservationMixin:
    """Slicer's, as far as it is used."""

    def addObserver(self, _object, event, method):
        CALLS.append(f"VTKObservationMixin.addObserver({event!r}, {method.__name__})")

    def removeObservers(self):
        CALLS.append("VTKObservationMixin.removeObservers()")


def make_modules(start_module):
    """The modules by name. start_module(node, parameters) begins a run of the command line module."""
    CALLS.clear()
    slicer = ClassModule("slicer", ("vtk", "qMRML", "qSlicer"))
    slicer.__path__ = []
    slicer.mrmlScene = StandIn("vtkMRMLScene")
    slicer.vtkMRMLNode = StandIn
    layout = StandIn("qMRMLLayoutManager")
    BEHAVIOR["qSlicerApplication", "layoutManager"] = lambda _app: layout
    slicer.app = StandIn("qSlicerApplication")
    slicer.modules = StrictModule("slicer.modules")
    for name, kind in {
        "colors": "vtkSlicerColorLogic",
        "markups": "vtkSlicerMarkupsLogic",
        "cameras": "vtkSlicerCamerasModuleLogic",
        "segmentations": "vtkSlicerSegmentationsModuleLogic",
        "medialvoxelextraction": "vtkSlicerCLIModuleLogic",
    }.items():
        module = StrictModule(name)
        logic = StandIn(kind)
        module.logic = lambda logic=logic: logic
        module.kind, module.state = f"modules.{name}", {}
        setattr(slicer.modules, name, module)

    def run(_module, _node=None, parameters=None, **_options):
        for key, value in parameters.items():
            if not isinstance(value, (str, bool, int, float, StandIn)):
                raise TypeError(f"slicer.cli.setNodeParameters cannot take {key} = {value!r}")
        node = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLCommandLineModuleNode", "run")
        node.state["status"] = STATUS["Scheduled"]
        start_module(node, parameters)
        return node

    @contextlib.contextmanager
    def show_errors(_message=None, **_options):
        try:
            yield
        except Exception as error:  # noqa: BLE001 as Slicer does
            CALLS.append(f"message: {error}")

    slicer.cli = StrictModule("slicer.cli")
    slicer.cli.run = function("slicer.cli", "run", run)
    slicer.util = StrictModule("slicer.util")
    folder = tempfile.TemporaryDirectory()
    slicer.util.folder = folder
    behaviors = {"tempDirectory": lambda: folder.name, "tryWithErrorDisplay": show_errors}
    for name in ("setSliceViewerLayers", "resetThreeDViews", "tempDirectory", "tryWithErrorDisplay"):
        setattr(slicer.util, name, function("slicer.util", name, behaviors.get(name, lambda *a, **n: None)))
    slicer.util.VTKObservationMixin = ObservationMixin
    scripted = StrictModule("slicer.ScriptedLoadableModule")
    for name in ("", "Widget", "Logic", "Test"):
        setattr(scripted, f"ScriptedLoadableModule{name}", make_base(f"ScriptedLoadableModule{name}"))
    i18n = StrictModule("slicer.i18n")
    i18n.tr, i18n.translate = lambda text: text, lambda context, text: text
    return {
        "slicer": slicer,
        "slicer.util": slicer.util,
        "slicer.i18n": i18n,
        "slicer.ScriptedLoadableModule": scripted,
        "ctk": ClassModule("ctk", ("ctk",)),
        "qt": ClassModule("qt", ("Q",)),
    }


def install(start_module):
    """Puts the modules where import finds them. Returns slicer."""
    modules = make_modules(start_module)
    sys.modules.update(modules)
    return modules["slicer"]
