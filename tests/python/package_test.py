"""What the package promises beside its functions: its types, and the examples of its page."""

import ast
import os
import re
import unittest

import sweepface
from faces import FaceTest

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..", "..")


def publicNames(names):
    return {name for name in names if not name.startswith("_")}


class Types(unittest.TestCase):
    def setUp(self):
        with open(os.path.join(os.path.dirname(sweepface.__file__), "__init__.pyi")) as file:
            self.stub = ast.parse(file.read()).body

    def test_name_all_that_there_is(self):
        functions = {item.name for item in self.stub if isinstance(item, (ast.ClassDef, ast.FunctionDef))}
        self.assertEqual(functions | {"laws"}, publicNames(vars(sweepface)))
        for item in self.stub:
            if isinstance(item, ast.ClassDef) and item.name != "Error":
                members = publicNames(member.name for member in item.body if isinstance(member, ast.FunctionDef))
                self.assertEqual(members, publicNames(vars(getattr(sweepface, item.name))), item.name)

    def test_name_the_same_arguments(self):
        def check(function, text, owner):
            given = function.args
            defaults = [None] * (len(given.args) - len(given.defaults)) + given.defaults + given.kw_defaults
            for argument, default in zip(given.args + given.kwonlyargs, defaults):
                where = f"{owner}.{function.name}'s {argument.arg}"
                self.assertRegex(text, rf"\b{argument.arg}\b", where)
                real = re.search(rf"\b{argument.arg}: [^=:]*? = (.*?)(, \w+: |, \*|\) ->)", text)
                self.assertEqual(default is not None, real is not None, where)
                if real and ast.literal_eval(default) is not ...:
                    self.assertEqual(ast.literal_eval(default), ast.literal_eval(real.group(1)), where)

        for item in self.stub:
            if isinstance(item, ast.FunctionDef):
                check(item, getattr(sweepface, item.name).__doc__, "sweepface")
            for member in getattr(item, "body", []) if isinstance(item, ast.ClassDef) else []:
                if isinstance(member, ast.FunctionDef) and not member.decorator_list:
                    check(member, getattr(getattr(sweepface, item.name), member.name).__doc__, item.name)

    def test_are_of_the_package(self):
        self.assertEqual(sweepface.Rig.__module__, "sweepface")
        self.assertTrue(os.path.exists(os.path.join(os.path.dirname(sweepface.__file__), "py.typed")))
        self.assertRegex(sweepface.__version__, r"^\d+\.\d+\.\d+$")


class Examples(FaceTest):
    def setUp(self):
        super().setUp()
        self.rig.save(self.path("face.sweep"))
        self.writeObjs(self.rig.meshes())
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)

    def run_those_of(self, *page):
        with open(os.path.join(ROOT, *page), encoding="utf-8") as file:
            examples = re.findall(r"^```python\n(.*?)^```", file.read(), re.MULTILINE | re.DOTALL)
        self.assertGreater(len(examples), 0)
        names = {}
        for example in examples:
            exec(compile(example, page[-1], "exec"), names)

    def test_of_the_readme_run(self):
        self.run_those_of("README.md")

    def test_of_the_page_run(self):
        self.run_those_of("docs", "python.md")

    def writeObjs(self, meshes):
        """A small part of the face, as neutral.obj and a folder of expressions."""
        faces = meshes.faces[:200]
        used = sorted({vertex for face in faces for vertex in face})
        number = {vertex: k + 1 for k, vertex in enumerate(used)}
        os.mkdir(self.path("expressions"))
        shapes = {"neutral.obj": meshes.positions, "expressions/jawOpen.obj": meshes.targets["jawOpen"]}
        for name, positions in shapes.items():
            with open(self.path(name), "w") as file:
                for vertex in used:
                    file.write("v {} {} {}\n".format(*positions[vertex]))
                for face in faces:
                    file.write("f " + " ".join(str(number[vertex]) for vertex in face) + "\n")


if __name__ == "__main__":
    unittest.main()
