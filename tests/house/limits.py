"""The figures, the layers and the exemptions of the house rules. All of them stand here."""

LIMITS = {
    "private_methods": 20,  # a class or struct
    "data_members": 15,  # a class or struct that is not a record; static members do not count
    "record_helpers": 3,  # const or static methods that a record may have and still be one
    "class_files": 2,  # files that hold bodies of a class's methods: header and source
    "file_lines": 300,
    "function_lines": 60,  # from the line of its name to that of its closing brace
    "word_tables": 1,  # files that spell the enumerators of one enum class
}

PRODUCT = ("core", "drivers", "config", "firmware_bridge", "tools")
FOLDERS = (*PRODUCT, "tests")
SKIPPED = ("tests/data/",)  # data of the tests, not code

# Which layers, or single files, a layer may include beside itself. A file belongs to the layer with the longest folder
# that matches: the C interface at the top of firmware_bridge and the host below it know nothing of each other.
LAYERS = {
    "core": (),
    "drivers": ("core/probe_point.hpp",),
    "config": ("core", "drivers"),
    "firmware_bridge": ("core",),
    "firmware_bridge/host": ("core", "drivers"),
    "tools": ("core", "drivers", "config", "firmware_bridge", "firmware_bridge/host"),
    "tests": PRODUCT + ("firmware_bridge/host",),
}

# The files directly in these folders are a layer's face: what its rooms share (core/status.hpp) and what it offers
# (core/localizer.hpp). The search for circles takes each of these files by itself, and every other folder as a whole.
FACES = ("core", "drivers")

# Sources that need no header of their own name.
HEADERLESS = (
    "*/main.cpp",
    "core/geometry/simd/*.cpp",  # kernels: several share one header
)
# The folders whose sources need one. Of the tests these are the shared parts; the others are programs.
HEADER_FOLDERS = PRODUCT + ("tests/support",)

LOOSE_IN_TOOLS = ("main.cpp", "*.sh", "CMakeLists.txt", "README.md")

# Files that spell the same words as an enumeration for another vocabulary: (enumeration, file).
OTHER_VOCABULARIES = (
    ("Unit", "tools/design/iges/*"),  # the units of IGES
    ("Unit", "tools/commands/compile_command.cpp"),  # the unit of a design
    # What the operator reads on the screen is written for people: "FAULT", "needs more points", "elsewhere".
    ("*", "tools/panel/panel_words.cpp"),
    ("*", "firmware_bridge/host/panel/panel_texts.cpp"),
    # What the panel's registers are called in their printed map.
    ("*", "firmware_bridge/host/panel/panel_fields.cpp"),
    ("*", "tools/panel/panel_map_text.cpp"),
)
