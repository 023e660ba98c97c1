# Draws the jobs of jobs.json in VTK: python3 measure.py, run by tests/engines/vtk.py in the folder of all files.
# A job: model, kind (ours: cotan_vtk; back: the same, without culling; own: as VTK imports it), parts (1: lit), out
# (raw RGB images of bytes, one for each part).
import json
import os
import pathlib

import cotan_vtk
import numpy as np
import vtkmodules.all as vtk
from vtkmodules.util.numpy_support import vtk_to_numpy

NUMBERS = """
  float x = part == 0 ? normalVCVSOutput.x : part == 1 ? normalVCVSOutput.y : part == 2 ? normalVCVSOutput.z
          : part == 3 ? tcoordVCVSOutput.x : part == 4 ? tcoordVCVSOutput.y : 0.25;
  gl_FragData[0] = vec4(number_bytes(x), 1.0);
"""
whole = json.loads(pathlib.Path("jobs.json").read_text())
functions = pathlib.Path("cotan.glsl").read_text()
for job in whole["jobs"]:
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(whole["width"], whole["height"])
    renderer = vtk.vtkRenderer()
    window.AddRenderer(renderer)
    importer = vtk.vtkGLTFImporter()
    importer.SetFileName(job["model"])
    importer.SetRenderWindow(window)
    importer.Update()
    renderer.SetBackground(0, 0, 0)
    renderer.RemoveAllLights()
    light = vtk.vtkLight()
    light.SetLightTypeToSceneLight()
    light.SetPosition(-0.5, 0.6, 0.6)
    light.SetFocalPoint(0, 0, 0)
    light.SetIntensity(2)
    renderer.AddLight(light)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(0, 0, whole["eye"])
    camera.SetFocalPoint(0, 0, 0)
    camera.SetViewUp(0, 1, 0)
    camera.SetViewAngle(whole["field"])
    actors = list(renderer.GetActors())
    assert len(actors) == 2
    for actor in actors:
        assert actor.GetMapper().GetInput().GetPointData().GetTangents(), "the importer makes them"
        if job["kind"] == "back":
            actor.GetProperty().BackfaceCullingOff()
        if job["kind"] != "own":
            assert cotan_vtk.use(actor, functions)
        if job["parts"] > 1:
            shaders = actor.GetShaderProperty()
            shaders.AddFragmentShaderReplacement("//VTK::CustomUniforms::Dec", True, "//VTK::CustomUniforms::Dec\n" + whole["number_bytes"], False)
            shaders.AddFragmentShaderReplacement("//VTK::DepthPeeling::Impl", True, "//VTK::DepthPeeling::Impl\n" + NUMBERS, False)
    renderer.ResetCameraClippingRange()
    with open(job["out"], "wb") as file:
        for part in range(job["parts"]):
            for actor in actors:
                actor.GetShaderProperty().GetFragmentCustomUniforms().SetUniformi("part", part)
            window.Render()
            grab = vtk.vtkWindowToImageFilter()
            grab.SetInput(window)
            grab.ReadFrontBufferOff()
            grab.Update()
            pixels = vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars())
            file.write(np.ascontiguousarray(pixels.reshape(whole["height"], whole["width"], 3)[::-1]).tobytes())
    window.Finalize()
print("VTK", vtk.vtkVersion().GetVTKVersion())
print("DONE", flush=True)
os._exit(0)
