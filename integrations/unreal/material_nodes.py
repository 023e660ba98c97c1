"""Prints nodes as the graph of an Unreal material copies and pastes them: a Custom node with the HLSL functions of standard
input, and the nodes that it reads."""

import hashlib
import sys

CREDIT = "// Normal mapping without stored tangents, by the portable text of Cotan; MIT licence.\n"
CODE = """struct CotanFunctions
{
%s
} cotan;
#if PIXELSHADER
return cotan.cotan_perturb_normal(Normal, Position, UV, Texel);
#else
return Normal;
#endif"""

# Class, properties, and x and y in the graph of each node that the Custom node reads.
INPUTS = {
    "Normal": ("VertexNormalWS", [], (-500, -200)),
    "Position": ("WorldPosition", ["WorldPositionShaderOffset=WPT_CameraRelative"], (-500, -80)),
    "UV": ("TextureCoordinate", [], (-900, 80)),
    "Texel": ("TextureSampleParameter2D", ['ParameterName="Normal Map"', "SamplerType=SAMPLERTYPE_Normal",
              "Texture=\"/Script/Engine.Texture2D'/Engine/EngineMaterials/DefaultNormal.DefaultNormal'\""], (-600, 80)),
}  # fmt: skip


def guid(name):
    return hashlib.md5(f"cotan {name}".encode()).hexdigest().upper()


def escaped(code):
    return code.replace("\\", "\\\\").replace('"', '\\"').replace("\t", "\\t").replace("\n", "\\r\\n")


def expression(kind):
    return f"MaterialExpression{kind}_0"


def reference(kind, graph_node):
    return f"\"/Script/Engine.MaterialExpression{kind}'{graph_node}.{expression(kind)}'\""


def node(name, kind, properties, place, graph_kind="MaterialGraphNode"):
    x, y = place
    lines = [f'Begin Object Class=/Script/UnrealEd.{graph_kind} Name="{name}"',
             f'   Begin Object Class=/Script/Engine.MaterialExpression{kind} Name="{expression(kind)}"', "   End Object",
             f'   Begin Object Name="{expression(kind)}"']  # fmt: skip
    lines += [f"      {line}" for line in properties]
    lines += [f"      MaterialExpressionEditorX={x}", f"      MaterialExpressionEditorY={y}",
              f"      MaterialExpressionGuid={guid(kind)}", "   End Object",
              f"   MaterialExpression=\"/Script/Engine.MaterialExpression{kind}'{expression(kind)}'\"",
              f"   NodePosX={x}", f"   NodePosY={y}", f"   NodeGuid={guid(name)}", "End Object"]  # fmt: skip
    return lines


def main():
    text = [line.rstrip() for line in sys.stdin if not line.lstrip().startswith("//")]
    code = CODE % "\n".join("    " + line if line else "" for line in text).strip("\n")
    names = {name: f"MaterialGraphNode_{k}" for k, name in enumerate(INPUTS)}
    lines = []
    links = [f'Code="{escaped(CREDIT + code)}"',
             "OutputType=CMOT_Float3", 'Description="Cotan normal map"']  # fmt: skip
    for k, (name, (kind, properties, place)) in enumerate(INPUTS.items()):
        extra = list(properties)
        if name == "Texel":
            extra.append(f"Coordinates=(Expression={reference('TextureCoordinate', names['UV'])})")
        lines += node(names[name], kind, extra, place)
        mask = ",Mask=1,MaskR=1,MaskG=1,MaskB=1" if name == "Texel" else ""
        links.append(f'Inputs({k})=(InputName="{name}",Input=(Expression={reference(kind, names[name])}{mask}))')
    lines += node("MaterialGraphNode_Custom_0", "Custom", links, (-200, -100), "MaterialGraphNode_Custom")
    print("\n".join(lines))


main()
