"""Normal maps without tangents in VTK. README.md says how to print the functions.

    import cotan_vtk
    for actor in renderer.GetActors():
        cotan_vtk.use(actor, pathlib.Path("cotan.glsl").read_text())
"""

# VTK's shaders are GLSL 1.50; the functions need two of 3.30.
EXTENSION = "#extension GL_ARB_shader_bit_encoding : require\n"
# VTK flips the normal on back faces; the frame needs the surface's own.
NORMAL = """
  float cotanSide = gl_FrontFacing ? 1.0 : -1.0;
  normalVCVSOutput = cotanSide * cotan_perturb_normal(cotanSide * normalVCVSOutput, vertexVC.xyz, tcoordVCVSOutput,
      texture(normalTex, tcoordVCVSOutput).xyz);
"""


def use(actor, functions):
    """Draws the normal texture of an actor by functions, the text of `cotan shader`, and drops the tangents of its mesh.
    An actor without normal texture, normals or texture coordinates stays as it is, and the result is False."""
    data = actor.GetMapper().GetInput().GetPointData()
    if not actor.GetProperty().GetTexture("normalTex") or not data.GetTCoords() or not data.GetNormals():
        return False
    data.SetTangents(None)
    shaders = actor.GetShaderProperty()
    for tag, text in (("System::Dec", EXTENSION), ("Normal::Dec", functions), ("Normal::Impl", NORMAL)):
        shaders.AddFragmentShaderReplacement(f"//VTK::{tag}", True, f"//VTK::{tag}\n{text}", False)
    return True
