"""A line of tests/mutants.txt follows its place when names change, and is left alone if nothing is similar."""
import pathlib
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import repair  # noqa: E402

SOURCE = "int f(int wide)\n{\n    if (wide > kMost &&\n        wide < 9)\n        return 3;\n    return sum / wide;\n}\n"


class Repair(unittest.TestCase):
    def test_renamed_identifiers_are_followed_inside_and_outside_braces(self):
        self.assertEqual(repair.repaired("if (@{width > kMost}@ && width < 9) => false", SOURCE),
                         "if ( @{wide > kMost}@ && wide < 9) => false")
        self.assertEqual(repair.repaired("return @{sum}@ / width; => 0", SOURCE), "return @{sum}@ / wide; => 0")

    def test_no_line_is_suggested_without_a_similar_one(self):
        self.assertIsNone(repair.repaired("weights[k] = @{std::exp(-x)}@ * gain; => 1", SOURCE))

    def test_a_patch_has_the_line_number_and_both_texts(self):
        line = "return @{sum}@ / width; => 0"
        lines = repair.patch([(line, "a.cpp")], {"a.cpp": SOURCE, "tests/mutants.txt": f"# first\n{line}\n"})
        self.assertEqual(lines[2:], ["@@ -2 +2 @@", f"-{line}", "+return @{sum}@ / wide; => 0"])
        self.assertEqual(repair.patch([], {"tests/mutants.txt": ""}), [])


unittest.main()
