# SPDX-License-Identifier: Apache-2.0
"""The page about Python cannot go stale: its blocks run, one after the other, and print what is shown."""

import doctest
import os
import re
import tempfile
import unittest

PAGE = os.path.join(os.path.dirname(os.path.realpath(__file__)), "../../platform/doc/python.md")
NUMBER = re.compile(r"\d+(\.\d+)?")


class Near(doctest.OutputChecker):
    """The same text, blanks apart, and numbers within 10 %, as of the other pages."""

    def check_output(self, want, got, optionflags):
        if super().check_output(want, got, optionflags):
            return True
        shapes = [" ".join(NUMBER.sub("#", text).split()) for text in (want, got)]
        numbers = [[float(found.group()) for found in NUMBER.finditer(text)] for text in (want, got)]
        return shapes[0] == shapes[1] and all(abs(a - b) <= max(0.1 * a, 0.051) for a, b in zip(*numbers))


class Page(unittest.TestCase):
    def test_every_block_prints_what_is_shown(self):
        with open(PAGE) as file:
            text = file.read()
        blocks = re.findall(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
        self.assertGreater(len(blocks), 4)
        test = doctest.DocTestParser().get_doctest("\n".join(blocks), {}, "python.md", PAGE, 0)
        said = []
        here = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                result = doctest.DocTestRunner(Near()).run(test, out=said.append)
            finally:
                os.chdir(here)
        self.assertEqual(result.failed, 0, "".join(said))
        self.assertGreater(result.attempted, 20)

    def test_numbers_may_differ_by_a_tenth(self):
        near = Near()
        self.assertTrue(near.check_output("rate 100.2\n", "rate  104.9\n", 0))
        self.assertFalse(near.check_output("rate 100\n", "rate 120\n", 0))
        self.assertFalse(near.check_output("rate 100\n", "a rate 100\n", 0))


if __name__ == "__main__":
    unittest.main()
