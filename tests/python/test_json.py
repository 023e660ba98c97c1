"""docs/reference/json.md against the library's reports, as tests/json_fields_test.py does for the tool."""

import importlib.util
import sys

import pytest

import cotan
from shapes import write_stretched


@pytest.fixture(scope="module")
def fields(source):
    sys.path.insert(0, str(source / "tests"))  # for the modules beside it
    spec = importlib.util.spec_from_file_location("json_fields_test", source / "tests/json_fields_test.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.UNSEEN |= {
        "cotan-lint-result": {"primitives[].stored_tangents"},  # the model here has none
        "cotan-render-result": {"note", "frame_note"},
        "cotan-convert-result": {"unread_maps[]", "tangents.kept", "tangents.given_primitives", "tangents.anisotropy"},
    }
    return module


@pytest.fixture(scope="module")
def page(fields, source):
    return fields.Documented(source / "docs/reference/json.md")


def check(fields, page, name, reports):
    assert {(report["format"], report["version"]) for report in reports} == {(name, page.versions[name])}
    assert fields.differences(name, page, reports) == []


def test_fields_of_lint_equal_those_on_the_page(fields, page, tmp_path):
    model = write_stretched(tmp_path)
    reports = [cotan.lint(model).report, cotan.lint(model, limit=0.001, limit_area=1).report, cotan.lint(model, limit=180).report]
    check(fields, page, "cotan-lint-result", reports)


def test_every_field_of_convert_is_on_the_page(fields, page, tmp_path):
    model = write_stretched(tmp_path)
    done = [
        cotan.convert(model, tmp_path / "a.glb", to_frame="cotangent"),
        cotan.convert(model, tmp_path / "b.glb", to_frame="orthonormal"),
    ]
    check(fields, page, "cotan-convert-result", [one.report for one in done])


def test_every_field_of_render_is_on_the_page(fields, page, tmp_path):
    reports = [{}, {}]
    for report, view in zip(reports, ("shaded", "error")):
        cotan.render(write_stretched(tmp_path), size=(16, 16), device="reference", view=view, report=report)
    check(fields, page, "cotan-render-result", reports)
