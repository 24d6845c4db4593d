#!/usr/bin/env python3
"""Each rule finds what breaks it, and nothing else: small trees, each with one violation, and one without."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # the folder of the sources stays clean

from house_rules import violations
from tree import Tree

SCRIPT = pathlib.Path(__file__).with_name("house_rules.py")


def numbered(form, count):
    return "".join(form.format(number) + "\n" for number in range(count))


def class_of(private_methods=0, data_members=0):
    methods, members = numbered("  void act_{}();", private_methods), numbered("  double value_{}_ = 0;", data_members)
    return f"class Engine {{\n public:\n  void run();\n\n private:\n{methods}{members}}};\n"


CLEAN = {
    "CMakeLists.txt": "add_subdirectory(core)\n",
    "core/CMakeLists.txt": "file(GLOB_RECURSE SOURCES CONFIGURE_DEPENDS *.cpp)  # not ../*.cpp\n",
    "core/status.hpp": "#pragma once\nenum class Status { good_so_far, bad };\n",
    "core/fit/pose.hpp": '#pragma once\n#include "core/status.hpp"\n' + class_of(20, 15),
    "core/fit/pose.cpp": '#include "core/fit/pose.hpp"\nvoid Engine::run() {\n' + numbered("  use({});", 58) + "}\n",
    "core/localizer.hpp": '#pragma once\n#include "core/fit/pose.hpp"\n',
    "core/report.hpp": "struct Report {\n" + numbered("  double value_{} = 0;", 40) + "  bool good() const;\n};\n",
    "tools/main.cpp": '#include "core/localizer.hpp"\n' + numbered("// {}", 299),
    "tools/start.sh": "",
    "tools/README.md": "",
    "tools/results/words.hpp": 'constexpr const char* kWords[] = {"good-so-far", "bad"};\n',
    "tools/results/help.hpp": '// "good_so_far", "bad"\nconst char* kHelp = "good_so_far or bad"; /* "bad" */\n',
    "tests/unit/pose_test.cpp": '#include "core/fit/pose.hpp"\n#include "tools/results/words.hpp"\n',
    "tests/data/long.cpp": numbered("int data_{};", 400),
}


class HouseRules(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)

    def write(self, files):
        for path, text in files.items():
            (self.root / path).parent.mkdir(parents=True, exist_ok=True)
            (self.root / path).write_text(text, encoding="utf-8")

    def expect(self, files, *expected):
        """The clean tree with these files in it has these violations and no others."""
        self.write({**CLEAN, **files})
        found = [f"{path}:{line}: {rule}: {what}" for path, line, rule, what in violations(Tree(self.root))]
        self.assertEqual(found, list(expected))

    def run_script(self, *arguments):
        return subprocess.run([sys.executable, SCRIPT, *arguments], capture_output=True, text=True)

    def test_a_tree_at_its_limits_has_no_violation(self):
        self.expect({})

    def test_a_class_with_too_many_private_methods_is_found(self):
        self.expect({"core/engine.hpp": class_of(private_methods=21)},
                    "core/engine.hpp:1: private-methods: class Engine has 21 private methods (limit 20)")

    def test_a_class_with_too_many_data_members_is_found(self):
        self.expect({"core/engine.hpp": class_of(data_members=16)},
                    "core/engine.hpp:1: data-members: class Engine has 16 data members (limit 15)")

    def test_aligned_members_count_and_static_ones_do_not(self):
        members = "  alignas(32) double rows_[4], sums_[4];\n  static constexpr int kSize = 4;\n"
        self.expect({"core/engine.hpp": class_of(data_members=14).replace("};\n", members + "};\n")},
                    "core/engine.hpp:1: data-members: class Engine has 16 data members (limit 15)")

    def test_a_struct_whose_methods_change_it_is_no_record(self):
        struct = "struct Sums {\n" + numbered("  double value_{} = 0;", 16) + "  void add(double value);\n};\n"
        self.expect({"core/sums.hpp": struct},
                    "core/sums.hpp:1: data-members: struct Sums has 16 data members (limit 15)")

    def test_a_struct_with_a_private_part_is_no_record(self):
        struct = "struct Sums {\n" + numbered("  double value_{} = 0;", 15) + " private:\n  int count_ = 0;\n};\n"
        self.expect({"core/sums.hpp": struct},
                    "core/sums.hpp:1: data-members: struct Sums has 16 data members (limit 15)")

    def test_a_struct_with_many_helpers_is_no_record(self):
        helpers = numbered("  double helper_{}() const;", 4)
        struct = "struct Sums {\n" + numbered("  double value_{} = 0;", 16) + helpers + "};\n"
        self.expect({"core/sums.hpp": struct},
                    "core/sums.hpp:1: data-members: struct Sums has 16 data members (limit 15)")

    def test_a_class_over_three_files_is_found(self):
        self.expect({"core/engine.hpp": "namespace bladefit {\nclass Engine { void a(); void b(); void c() {} };\n}\n",
                     "core/engine.cpp": "namespace bladefit {\nvoid Engine::a() {}\n}\n",
                     "core/more.hpp": "", "core/more.cpp": "void bladefit::Engine::b() {}\n"},
                    "core/engine.hpp:2: class-files: methods of Engine are defined in 3 files (limit 2): "
                    "core/engine.cpp, core/engine.hpp, core/more.cpp")

    def test_a_source_without_its_header_is_found_and_a_kernel_is_none(self):
        self.expect({"core/fit/loss.cpp": "", "core/geometry/simd/rows.cpp": "", "tests/unit/loss_test.cpp": ""},
                    "core/fit/loss.cpp:1: own-header: no loss.hpp beside it")

    def test_long_files_are_found(self):
        self.expect({"core/long.hpp": numbered("// {}", 301), "tests/long.py": numbered("# {}", 301),
                     "tools/long.sh": numbered("# {}", 301)},
                    "core/long.hpp:1: file-lines: 301 lines (limit 300)",
                    "tests/long.py:1: file-lines: 301 lines (limit 300)",
                    "tools/long.sh:1: file-lines: 301 lines (limit 300)")

    def test_long_functions_are_found(self):
        body = "{\n" + numbered("  use({});", 59) + "}\n"
        self.expect({"core/act.hpp": "\nvoid act() " + body, "tests/unit/act_test.cpp": "TEST(Act, Sentence) " + body,
                     "tests/act.py": "def act():\n" + numbered("    use({})", 60)},
                    "core/act.hpp:2: function-lines: act has 61 lines (limit 60)",
                    "tests/act.py:1: function-lines: act has 61 lines (limit 60)",
                    "tests/unit/act_test.cpp:1: function-lines: TEST(Act,Sentence) has 61 lines (limit 60)")

    def test_a_circle_of_two_folders_is_found(self):
        self.expect({"core/fit/b.hpp": '#include "core/geometry/a.hpp"\n#include "core/geometry/c.hpp"\n',
                     "core/geometry/a.hpp": '\n#include "core/fit/b.hpp"\n', "core/geometry/c.hpp": ""},
                    "core/geometry/a.hpp:2: folder-circle: core/fit -> core/geometry"
                    " (core/fit/b.hpp:1, core/fit/b.hpp:2) -> core/fit (core/geometry/a.hpp:2)")

    def test_a_circle_of_three_folders_is_found(self):
        self.expect({"tools/a/a.hpp": '#include "tools/b/b.hpp"\n', "tools/b/b.hpp": '#include "../c/c.hpp"\n',
                     "tools/c/c.hpp": '#include "tools/a/d.hpp"\n', "tools/a/d.hpp": ""},
                    "tools/a/a.hpp:1: folder-circle: tools/a -> tools/b (tools/a/a.hpp:1) -> tools/c (tools/b/b.hpp:1)"
                    " -> tools/a (tools/c/c.hpp:1)")

    def test_a_circle_through_a_file_of_the_face_is_found(self):
        self.expect({"core/face.hpp": '#include "core/fit/low.hpp"\n',
                     "core/fit/low.hpp": '#include "core/face.hpp"\n'},
                    "core/face.hpp:1: folder-circle: core/face.hpp -> core/fit (core/face.hpp:1) -> core/face.hpp"
                    " (core/fit/low.hpp:1)")

    def test_includes_against_the_layers_are_found(self):
        self.expect({"core/up.hpp": '#include "drivers/port.hpp"\n',
                     "drivers/port.hpp": '#include "core/status.hpp"\n',
                     "drivers/point.hpp": '#include "core/probe_point.hpp"\n', "core/probe_point.hpp": "",
                     "firmware_bridge/abi.hpp": '#include "firmware_bridge/host/host.hpp"\n',
                     "firmware_bridge/host/host.hpp": "", "tools/a/a.hpp": '#include "tests/support/b.hpp"\n',
                     "tests/support/b.hpp": ""},
                    "core/up.hpp:1: layers: core includes drivers/port.hpp (allowed: core)",
                    "drivers/port.hpp:1: layers: drivers includes core/status.hpp"
                    " (allowed: drivers, core/probe_point.hpp)",
                    "firmware_bridge/abi.hpp:1: layers: firmware_bridge includes firmware_bridge/host/host.hpp"
                    " (allowed: firmware_bridge, core)",
                    "tools/a/a.hpp:1: layers: tools includes tests/support/b.hpp"
                    " (allowed: tools, core, drivers, config, firmware_bridge, firmware_bridge/host)")

    def test_a_loose_file_in_tools_is_found(self):
        self.expect({"tools/options.hpp": ""},
                    "tools/options.hpp:1: loose-file: lies in tools itself"
                    " (allowed: main.cpp, *.sh, CMakeLists.txt, README.md)")

    def test_the_words_of_an_enumeration_in_two_files_are_found(self):
        self.expect({"config/words.hpp": 'constexpr const char* kWords[] = {\n"good so far", "bad"};\n'},
                    "core/status.hpp:2: enum-words: the words of Status stand in 2 files (limit 1): config/words.hpp:2,"
                    " tools/results/words.hpp:1")

    def test_the_words_of_the_screen_are_a_vocabulary_of_their_own(self):
        words = CLEAN["tools/results/words.hpp"]
        self.expect({"tools/panel/panel_words.cpp": words, "tools/panel/panel_words.hpp": ""})

    def test_a_filter_by_regular_expression_is_found(self):
        self.expect({"core/CMakeLists.txt": '\nlist(FILTER SOURCES\n  EXCLUDE REGEX "/(a|b)/")\n'},
                    "core/CMakeLists.txt:2: cmake-filter: list(FILTER ... REGEX) says what folders should say")

    def test_a_glob_outside_its_folder_is_found(self):
        self.expect({"core/CMakeLists.txt": "file(GLOB A ${CMAKE_CURRENT_SOURCE_DIR}/fit/*.cpp)\n"
                                            "file(GLOB B CONFIGURE_DEPENDS fit/*.cpp\n  ../drivers/*.cpp)\n"
                                            "file(GLOB_RECURSE C ${PROJECT_SOURCE_DIR}/core/*.cpp)\n"},
                    "core/CMakeLists.txt:2: cmake-glob: ../drivers/*.cpp reaches outside its own folder",
                    "core/CMakeLists.txt:4: cmake-glob: ${PROJECT_SOURCE_DIR}/core/*.cpp reaches outside its own"
                    " folder")

    def test_the_script_fails_where_there_is_a_violation_and_only_there(self):
        self.write(CLEAN)
        good = self.run_script("--root", self.root)
        self.assertEqual((good.returncode, good.stdout), (0, "house rules: 13 files, 0 violations\n"))
        self.write({"tools/options.hpp": ""})
        bad = self.run_script("--root", self.root)
        self.assertEqual((bad.returncode, bad.stdout.splitlines()[-1]), (1, "house rules: 14 files, 1 violations"))

    def test_files_that_git_ignores_are_passed_over(self):
        self.write({**CLEAN, ".gitignore": "*.draft.hpp\n", "tools/new.draft.hpp": ""})
        subprocess.run(["git", "init", "--quiet", self.root], check=True)
        self.assertEqual(violations(Tree(self.root)), [])

    def test_a_folder_without_the_house_is_not_taken_for_a_clean_one(self):
        self.write({"elsewhere/a.hpp": ""})
        run = self.run_script("--root", self.root)
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        self.assertIn("no files of the house", run.stderr)

    def test_help_names_every_rule(self):
        words = self.run_script("--help").stdout
        for rule in ("private-methods", "data-members", "class-files", "own-header", "file-lines", "function-lines",
                     "layers", "folder-circle", "loose-file", "enum-words", "cmake-filter", "cmake-glob"):
            self.assertIn(rule, words)


if __name__ == "__main__":
    unittest.main()
