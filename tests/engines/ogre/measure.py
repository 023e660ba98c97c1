# Draws rings in OGRE: python3 measure.py JOBS, run in the folder of the resources by tests/engines/ogre.py.
# JOBS: a JSON file: size, eye, field, media (OGRE's folder), and jobs. A job: rings (folders with the files
# position, normal, uv, corners), materials (one each; a float `part` tells the fragment program what to write), matrices
# (by columns), parts (0: a lit image of bytes, RGB), tangents (whether OGRE makes them), out.
import json
import os
import pathlib
import sys

import numpy as np
import Ogre
import Ogre.Numpy

jobs = json.loads(pathlib.Path(sys.argv[1]).read_text())
width, height = jobs["size"]
root = Ogre.Root("", "", "ogre.log")
root.loadPlugin(jobs["plugins"] + "/RenderSystem_GL3Plus")
root.loadPlugin(jobs["plugins"] + "/Codec_STBI")
root.setRenderSystem(root.getRenderSystemByName("OpenGL 3+ Rendering Subsystem"))
root.initialise(False)
window = root.createRenderWindow("measure", width, height, False)
resources = Ogre.ResourceGroupManager.getSingleton()
resources.addResourceLocation(jobs["media"] + "/Main", "FileSystem", Ogre.RGN_INTERNAL)
resources.addResourceLocation(".", "FileSystem", Ogre.RGN_DEFAULT)
resources.initialiseAllResourceGroups()


def mesh_of(name, folder, tangents):
    position, normal, uv = (np.fromfile(f"{folder}/{part}", np.float32).reshape(-1, n).tolist() for part, n in (("position", 3), ("normal", 3), ("uv", 2)))
    made = Ogre.ManualObject(name)
    made.begin("BaseWhiteNoLighting")
    for p, n, t in zip(position, normal, uv):
        made.position(*p)
        made.normal(*n)
        made.textureCoord(*t)
    for corner in np.fromfile(f"{folder}/corners", np.uint16).tolist():
        made.index(corner)
    made.end()
    mesh = made.convertToMesh(name)
    before = mesh.getSubMesh(0).vertexData.vertexDeclaration.getVertexSize(0)
    if tangents:
        mesh.buildTangentVectors(0, False, False, True)
        print("vertex", before, mesh.getSubMesh(0).vertexData.vertexDeclaration.getVertexSize(0))
    return mesh


for number, job in enumerate(jobs["jobs"]):
    scene = root.createSceneManager()
    scene.setAmbientLight(Ogre.ColourValue(0.1, 0.1, 0.1))
    light = scene.createLight(f"light{number}")
    light.setType(Ogre.Light.LT_DIRECTIONAL)
    light.setDiffuseColour(Ogre.ColourValue(0.8, 0.8, 0.8))
    holder = scene.getRootSceneNode().createChildSceneNode()
    holder.setDirection(Ogre.Vector3(0.5, -0.6, -0.6), Ogre.Node.TS_WORLD)
    holder.attachObject(light)
    materials = []
    for k, (folder, material, columns) in enumerate(zip(job["rings"], job["materials"], job["matrices"])):
        entity = scene.createEntity(mesh_of(f"ring{number}_{k}", folder, job["tangents"]))
        entity.setMaterialName(material)
        materials.append(entity.getSubEntity(0).getMaterial())
        m = np.array(columns).reshape(4, 4).T
        node = scene.getRootSceneNode().createChildSceneNode()
        node.setPosition(*m[:3, 3].tolist())
        axes = [Ogre.Vector3(*m[:3, i].tolist()) for i in range(3)]
        node.setOrientation(Ogre.Quaternion(*axes))
        node.attachObject(entity)
    camera = scene.createCamera(f"camera{number}")
    camera.setNearClipDistance(0.1)
    camera.setAspectRatio(width / height)
    camera.setFOVy(Ogre.Radian(np.radians(jobs["field"])))
    place = scene.getRootSceneNode().createChildSceneNode()
    place.setPosition(0, 0, jobs["eye"])
    place.attachObject(camera)
    kind = Ogre.PF_FLOAT32_RGBA if job["parts"] else Ogre.PF_BYTE_RGB
    textures = Ogre.TextureManager.getSingleton()
    texture = textures.createManual(f"target{number}", Ogre.RGN_DEFAULT, Ogre.TEX_TYPE_2D, width, height, 1, 0, kind, Ogre.TU_RENDERTARGET)
    target = texture.getBuffer().getRenderTarget()
    view = target.addViewport(camera)
    view.setBackgroundColour(Ogre.ColourValue(0, 0, 0, 0))
    view.setOverlaysEnabled(False)
    file = open(job["out"], "wb")
    for part in range(max(job["parts"], 1)):
        for material in materials:
            program = material.getTechnique(0).getPass(0)
            if job["parts"]:
                program.getFragmentProgramParameters().setNamedConstant("part", float(part))
            assert program.getFragmentProgram().isSupported() and program.getVertexProgram().isSupported(), "OGRE refuses the program"
        target.update()
        image = Ogre.Image(kind, width, height)
        texture.getBuffer().blitToMemory(image.getPixelBox())
        file.write(Ogre.Numpy.view(image.getPixelBox()).tobytes())
    file.close()
print("OGRE", Ogre.__version__)
print("DONE", flush=True)
os._exit(0)  # Python would free textures after OGRE itself
