// COLLADA and PLY: textures, cameras and nodes of COLLADA, headers of PLY, and each fault on its own.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "model_file.hpp"

namespace cotan {
namespace {

// ---- COLLADA ----------------------------------------------------------------------------------------

struct Collada {
    std::string sampler;        // of the diffuse texture, in Maya's syntax
    std::string uvName = "UV0"; // the set that the texture reads
    std::string nodes = "<node id=\"n\"><instance_geometry url=\"#g\"><bind_material><technique_common>"
                        "<instance_material symbol=\"M\" target=\"#m\"><bind_vertex_input semantic=\"UV0\" "
                        "input_semantic=\"TEXCOORD\" input_set=\"0\"/><bind_vertex_input semantic=\"UV1\" "
                        "input_semantic=\"TEXCOORD\" input_set=\"1\"/></instance_material></technique_common>"
                        "</bind_material></instance_geometry></node>";
    std::string libraries;
    std::string positions = "0 0 0 1 0 0 0 1 0";
    int counted = 9; // the count that the array states

    std::string text() const
    {
        const auto source = [](const char* id, const std::string& numbers, int count, int stride) {
            std::string params;
            for (int i = 0; i < stride; ++i)
                params += fmt::format("<param name=\"{}\" type=\"float\"/>", "XYZ"[i]);
            return fmt::format("<source id=\"{0}\"><float_array id=\"{0}a\" count=\"{1}\">{2}</float_array>"
                               "<technique_common><accessor source=\"#{0}a\" count=\"3\" stride=\"{3}\">{4}</accessor>"
                               "</technique_common></source>",
                               id, count, numbers, stride, params);
        };
        return "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
               "version=\"1.4.1\"><asset><up_axis>Y_UP</up_axis></asset>"
               "<library_images><image id=\"i\"><init_from>a.png</init_from></image></library_images>"
               "<library_effects><effect id=\"e\"><profile_COMMON>"
               "<newparam sid=\"s\"><surface type=\"2D\"><init_from>i</init_from></surface></newparam>"
               "<newparam sid=\"t\"><sampler2D><source>s</source></sampler2D></newparam>"
               "<technique sid=\"c\"><lambert><diffuse><texture texture=\"t\" texcoord=\""
            + uvName + "\"><extra><technique profile=\"MAYA\">" + sampler
            + "</technique></extra></texture></diffuse></lambert></technique></profile_COMMON></effect>"
              "</library_effects><library_materials><material id=\"m\" name=\"m\"><instance_effect url=\"#e\"/>"
              "</material></library_materials>"
            + libraries + "<library_geometries><geometry id=\"g\" name=\"g\"><mesh>"
            + source("p", positions, counted, 3) + source("u", "0 0 1 0 0 1", 6, 2)
            + source("w", "0.5 0 1 0 0 0.25", 6, 2)
            + "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>"
              "<triangles count=\"1\" material=\"M\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>"
              "<input semantic=\"TEXCOORD\" source=\"#u\" offset=\"0\" set=\"0\"/>"
              "<input semantic=\"TEXCOORD\" source=\"#w\" offset=\"0\" set=\"1\"/><p>0 1 2</p></triangles></mesh>"
              "</geometry></library_geometries><library_visual_scenes><visual_scene id=\"vs\">"
            + nodes
            + "</visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#vs\"/></scene></COLLADA>";
    }
};

TEST_F(ModelFile, colladaWrapsEachDirectionByItself)
{
    paint("a.png", {10, 20, 200});
    for (const auto& [words, u, v] :
         {std::tuple("<wrapU>1</wrapU><wrapV>1</wrapV>", Wrap::repeat, Wrap::repeat),
          {"<wrapU>0</wrapU><wrapV>1</wrapV>", Wrap::clamp, Wrap::repeat},
          {"<wrapU>1</wrapU><wrapV>0</wrapV>", Wrap::repeat, Wrap::clamp},
          {"<wrapU>1</wrapU><wrapV>1</wrapV><mirrorU>1</mirrorU>", Wrap::mirror, Wrap::repeat},
          {"<wrapU>1</wrapU><wrapV>1</wrapV><mirrorV>1</mirrorV>", Wrap::repeat, Wrap::mirror}}) {
        Collada collada;
        collada.sampler = words;
        const Scene scene = get("a.dae", collada.text());
        const Material& m = scene.materials.at(std::size_t(scene.meshes.at(0).material));
        ASSERT_TRUE(m.baseColorMap.present()) << words;
        EXPECT_EQ(m.baseColorMap.sampler.wrapU, u) << words;
        EXPECT_EQ(m.baseColorMap.sampler.wrapV, v) << words;
        EXPECT_EQ(m.name, "m");
    }
}

// Scaled, rotated about the centre of the image, and shifted, with v up.
TEST_F(ModelFile, colladaTextureTransformsAreApplied)
{
    paint("a.png", {10, 20, 200});
    struct Row {
        glm::dvec2 scale, offset;
        double angle;
    };
    for (const Row& row : {Row{{1, 1}, {0, 0}, 0},
                           {{2, 3}, {0, 0}, 0},
                           {{1, 1}, {0.25, 0.125}, 0},
                           {{1, 1}, {0, 0}, 0.5},
                           {{2, 0.5}, {0.125, -0.25}, -1.25}}) {
        Collada collada;
        collada.sampler = fmt::format("<repeatU>{}</repeatU><repeatV>{}</repeatV><offsetU>{}</offsetU>"
                                      "<offsetV>{}</offsetV><rotateUV>{}</rotateUV>",
                                      row.scale.x, row.scale.y, row.offset.x, row.offset.y, row.angle);
        const Scene scene = get("a.dae", collada.text());
        const Texture& t = scene.materials.at(std::size_t(scene.meshes.at(0).material)).baseColorMap;
        for (const glm::dvec2 up : {glm::dvec2(0, 0), {1, 0}, {0.25, 0.75}}) {
            const glm::dvec2 from = up * row.scale - 0.5;
            const double c = std::cos(row.angle), s = std::sin(row.angle);
            const glm::dvec2 to = glm::dvec2(c * from.x - s * from.y, s * from.x + c * from.y) + 0.5 + row.offset;
            const glm::vec3 down(up.x, 1 - up.y, 1);
            EXPECT_NEAR(glm::dot(t.uRow, down), to.x, 1e-5) << collada.sampler;
            EXPECT_NEAR(glm::dot(t.vRow, down), 1 - to.y, 1e-5) << collada.sampler;
        }
    }
}

TEST_F(ModelFile, colladaTexturesUseTheirNamedUvSet)
{
    paint("a.png", {10, 20, 200});
    for (const int set : {0, 1}) {
        Collada collada;
        collada.uvName = fmt::format("UV{}", set);
        const Scene scene = get("a.dae", collada.text());
        const Mesh& mesh = scene.meshes.at(0);
        EXPECT_EQ(scene.materials.at(std::size_t(mesh.material)).baseColorMap.texcoord, set);
        ASSERT_EQ(mesh.texcoords[0].size(), 3u);
        ASSERT_EQ(mesh.texcoords[1].size(), 3u);
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::vec2 p(mesh.positions[i]);
            EXPECT_EQ(mesh.texcoords[0][i], glm::vec2(p.x, 1 - p.y));
            EXPECT_EQ(mesh.texcoords[1][i], glm::vec2(p.x + p.y == 0 ? 0.5f : p.x, 1 - p.y / 4));
        }
    }
}

TEST_F(ModelFile, colladaAccessorsStayWithinTheirArray)
{
    Collada collada;
    EXPECT_EQ(refusal("a.dae", collada.text()), "");
    collada.counted = 8;
    EXPECT_NE(
        refusal("a.dae", collada.text()).find("accessor of #pa: expected an array of at least 9 numbers, found 8"),
        std::string::npos);
    collada.counted = 10;
    collada.positions += " 0";
    EXPECT_EQ(refusal("a.dae", collada.text()), "");
    std::string text = Collada().text();
    const std::size_t at = text.find("stride=\"3\"");
    text.insert(at, "offset=\"1\" ");
    EXPECT_NE(refusal("a.dae", text).find("expected an array of at least 10 numbers, found 9"), std::string::npos);
    text = Collada().text();
    text.replace(text.find("stride=\"3\""), 10, "stride=\"4\"");
    EXPECT_NE(refusal("a.dae", text).find("expected an array of at least 11 numbers, found 9"), std::string::npos);
    EXPECT_NE(refusal("a.dae", std::string("<COLLADA>\0</COLLADA>", 20)).find("found a zero byte"), std::string::npos);
    for (const std::string element : {"p", "h", "v", "vcount", "int_array"}) {
        const auto fault = [&](const std::string& inside) {
            return refusal("a.dae", "<COLLADA><" + element + inside + "</" + element + "></COLLADA>");
        };
        const std::string words = "only integers in <" + element + ">";
        EXPECT_NE(fault(">0 1 x").find(words), std::string::npos) << element;
        EXPECT_NE(fault(" a='b'>0 1.5").find(words), std::string::npos) << element;
        EXPECT_EQ(fault(">0 -1 +2\t3\n").find(words), std::string::npos) << element;
        EXPECT_EQ(fault("x>abc").find(words), std::string::npos) << element; // another element with a longer name
    }
    for (const std::string attribute : {"count", "offset", "stride"})
        for (const char quote : {'"', '\''}) {
            const std::string open = "<COLLADA><a " + attribute + "=" + quote,
                              close = std::string(1, quote) + "/></COLLADA>";
            const std::size_t size = (open + "99" + close).size(); // a count up to the file's size fits
            const std::string words = "expected a " + attribute + " that fits the file";
            EXPECT_EQ(refusal("a.dae", open + std::to_string(size) + close).find(words), std::string::npos)
                << attribute;
            EXPECT_NE(refusal("a.dae", open + std::to_string(size + 1) + close).find(words), std::string::npos)
                << attribute;
            EXPECT_NE(refusal("a.dae", open + "99999999999999999999" + close).find(words), std::string::npos);
        }
}

TEST_F(ModelFile, colladaNodesAreTransformedLimitedAndLoseTheirLights)
{
    paint("a.png", {10, 20, 200});
    const std::string use = "<instance_geometry url=\"#g\"/>";
    Collada collada;
    collada.nodes = "<node id=\"a\" name=\"a\"><translate>1 2 3</translate>" + use
        + "<node id=\"b\" name=\"b\"><rotate>0 0 1 90</rotate>" + use + "</node></node><node id=\"c\" name=\"c\">" + use
        + "<instance_light url=\"#l\"/></node>";
    collada.libraries = "<library_lights><light id=\"l\"><technique_common><point><color>1 1 1</color></point>"
                        "</technique_common></light></library_lights>";
    LoadLimits limits;
    limits.nodes = 4; // including the root
    const Scene scene = get("a.dae", collada.text(), limits);
    limits.nodes = 3;
    EXPECT_NE(refusal("a.dae", collada.text(), limits).find("over the limit of 3 nodes"), std::string::npos);
    ASSERT_EQ(scene.instances.size(), 3u);
    EXPECT_EQ(scene.instances[0].name, "a");
    EXPECT_EQ(scene.instances[1].name, "b");
    EXPECT_EQ(scene.instances[2].name, "c");
    const auto at = [&](std::size_t i, const glm::vec3& p) {
        return glm::vec3(scene.instances[i].toWorld * glm::vec4(p, 1));
    };
    EXPECT_NEAR(glm::length(at(0, {1, 0, 0}) - glm::vec3(2, 2, 3)), 0, 1e-5);
    EXPECT_NEAR(glm::length(at(1, {1, 0, 0}) - glm::vec3(1, 3, 3)), 0, 1e-5); // x becomes y
    EXPECT_NEAR(glm::length(at(2, {1, 0, 0}) - glm::vec3(1, 0, 0)), 0, 1e-5);
    EXPECT_TRUE(says(scene, "1 lights are ignored: this format defines no unit"));
    EXPECT_EQ(scene.meshes.size(), 1u);
}

TEST_F(ModelFile, invalidColladaCamerasAreSkippedWithAWarning)
{
    const auto with = [&](const std::string& perspective, const std::string& transform) {
        Collada collada;
        collada.libraries = "<library_cameras><camera id=\"k\" name=\"k\"><optics><technique_common><perspective>"
            + perspective
            + "<znear>0.1</znear><zfar>100</zfar></perspective></technique_common></optics></camera></library_cameras>";
        collada.nodes += "<node id=\"k1\" name=\"k1\">" + transform + "<instance_camera url=\"#k\"/></node>";
        return get("a.dae", collada.text());
    };
    const Scene good = with("<yfov>30</yfov><aspect_ratio>1.5</aspect_ratio>", "<rotate>0 1 0 90</rotate>");
    ASSERT_EQ(good.cameras.size(), 1u);
    EXPECT_NEAR(good.cameras[0].verticalFieldOfView, 0.5235988, 1e-4);
    const glm::vec3 forward = glm::normalize(good.cameras[0].target - good.cameras[0].eye);
    EXPECT_NEAR(glm::length(forward - glm::vec3(-1, 0, 0)), 0, 1e-5); // -z, rotated by 90 degrees about y
    const Scene flat = with("<yfov>30</yfov><aspect_ratio>1.5</aspect_ratio>", "<scale>0 0 0</scale>");
    EXPECT_TRUE(flat.cameras.empty());
    EXPECT_TRUE(says(flat, "degenerate; left out"));
    const Scene narrow = with("<xfov>0.01</xfov><aspect_ratio>1.5</aspect_ratio>", "");
    EXPECT_TRUE(narrow.cameras.empty());
}

// ---- PLY ------------------------------------------------------------------------------------------

TEST_F(ModelFile, plyHeaderErrorsNameTheLine)
{
    const std::string numbers = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    const auto with = [&](const std::string& format, const std::string& vertex, const std::string& face) {
        return refusal("a.ply",
                       "ply\n" + format + vertex + "property float x\nproperty float y\nproperty float z\n" + face
                           + "property list uchar int vertex_indices\nend_header\n" + numbers);
    };
    const std::string format = "format ascii 1.0\n", vertex = "element vertex 3\n", face = "element face 1\n";
    EXPECT_EQ(with(format, vertex, face), "");
    EXPECT_EQ(with(format, "comment a b\nobj_info c\n" + vertex, face), "");
    EXPECT_NE(with("", vertex, face).find("line 2: expected the format line first"), std::string::npos);
    EXPECT_NE(with("format text 1.0\n", vertex, face).find("line 2: expected ascii"), std::string::npos);
    EXPECT_NE(with("format ascii\n", vertex, face).find("line 2: expected ascii"), std::string::npos);
    EXPECT_NE(with(format, vertex + format, face).find("line 4: expected ascii"), std::string::npos);
    EXPECT_NE(with(format, "\n" + vertex, face).find("line 3: expected a header line"), std::string::npos);
    EXPECT_NE(with(format, "element vertex x\n", face).find("line 3: expected a count at the end"), std::string::npos);
    EXPECT_NE(with(format, "element vertex 999999\n", face).find("999999 elements exceed"), std::string::npos);
    EXPECT_NE(with(format, "element 3d 3\n", face).find("starts with a letter, found \"3d\""), std::string::npos);
    EXPECT_NE(with(format, "property float q\n" + vertex, face).find("line 3: expected a type and a name"),
              std::string::npos);
    EXPECT_NE(with(format, vertex + "property quad q\n", face).find("line 4: expected a type and a name"),
              std::string::npos);
    EXPECT_NE(with(format, vertex, face + "property list float int q\n").find("integer type for the count of a list"),
              std::string::npos);
    LoadLimits limits;
    limits.vertices = 3;
    const std::string whole = "ply\n" + format + vertex + "property float x\nproperty float y\nproperty float z\n"
        + face + "property list uchar int vertex_indices\nend_header\n" + numbers;
    EXPECT_EQ(refusal("a.ply", whole, limits), "");
    limits.vertices = 2;
    EXPECT_NE(refusal("a.ply", whole, limits), "");
}

} // namespace
} // namespace cotan
