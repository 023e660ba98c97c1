// Three methods of transforming normals under a non-uniform scale.
#include <fmt/format.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "cotan/covector.hpp"
#include "figure.hpp"
#include "stage.hpp"
#include "truth.hpp"

namespace cotan::figures {

namespace {

struct TransformMethod {
    NormalTransform method;
    const char *file, *label, *caption;
};

constexpr TransformMethod kTransformMethods[] = {
    {NormalTransform::rotationOnly, "a-rotation", "rotation only", "R n: the scale is ignored."},
    {NormalTransform::undoScale, "b-undo-scale", "scale undone", "R S^-1 n, with R and S taken from the columns of M."},
    {NormalTransform::inverseTranspose, "c-inverse-transpose", "inverse transpose", "M^-T n: what covectors need."},
};

// The sphere with positions transformed by `m` and normals by the given method. The shader gets no matrix.
Scene stretchedScene(const glm::dmat3& m, NormalTransform method, const Image& map)
{
    Mesh mesh = makeSphere(0.5f, 128);
    scaleTexcoords(mesh, 4, 2);
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        mesh.positions[i] = glm::vec3(m * glm::dvec3(mesh.positions[i]));
        mesh.normals[i] = glm::vec3(transformNormal(method, m, Covector3d(glm::dvec3(mesh.normals[i]))).raw());
    }
    return sceneOf(std::move(mesh), map, dielectric({0.17f, 0.05f, 0.05f}, 0.4f));
}

// Angles between normals by the given method and by the inverse transpose, over a sphere's vertices without map.
AngleStatistics vertexAngles(const glm::dmat3& m, NormalTransform method)
{
    std::vector<float> degrees;
    for (const glm::vec3& normal : makeSphere(1, 256).normals) {
        const Covector3d n{glm::dvec3(normal)};
        degrees.push_back(float(glm::degrees(
            angle(transformNormal(method, m, n), transformNormal(NormalTransform::inverseTranspose, m, n)))));
    }
    return angleStatistics(degrees);
}

glm::dmat3 scaled(double x, double y, double z) { return glm::dmat3(x, 0, 0, 0, y, 0, 0, 0, z); }

} // namespace

Figure makeNormalMatrixFigure(FigureRenderer& studio)
{
    Figure figure;
    figure.title = "Non-uniform scale and three normal matrices";
    figure.text = {"A normal-mapped sphere rotated by 40 degrees and then scaled 1 : 3 : 1, so that M is not a "
                   "rotation after a scale along "
                   "the axes, as under a scaled parent. The positions are right in all three; only the normals at the "
                   "vertices differ. "
                   "A normal is a covector and transforms by the inverse transpose. The two shortcuts shade the sphere "
                   "as another shape; the "
                   "bumps sit on that wrong shape."};
    figure.measured = "Angles to the inverse transpose. 'vertex normals' are without the map; for a plain scale 1 : 1 "
                      ": 4 the rotation alone "
                      "has an error of at most atan(3/4) = 36.87 degrees.";
    const Image map = heightMap16([](double u, double v) { return relief(Relief::domes, u, v); }, 512);
    const View view = squareView(studio, frontal(3.1f));
    const glm::dmat3 rotation(glm::rotate(glm::dmat4(1), glm::radians(40.0), glm::dvec3(0, 0, 1)));
    const glm::dmat3 m = scaled(1, 3, 1) * rotation;

    const Scene right = stretchedScene(m, NormalTransform::inverseTranspose, map);
    studio.show(right);
    const Image truth = studio.normals(view, Frame::cotangent);
    std::vector<Panel> heats;
    for (const TransformMethod& method : kTransformMethods) {
        const Scene scene = stretchedScene(m, method.method, map);
        studio.show(scene);
        figure.panels.push_back({method.file, method.label, method.caption, studio.shaded(view, Frame::cotangent)});
        if (method.method == NormalTransform::inverseTranspose)
            continue;
        Compared c = compareNormals(studio.normals(view, Frame::cotangent), truth);
        figure.measures.push_back({fmt::format("{}, as drawn", method.label), c.degrees});
        figure.measures.push_back(
            {fmt::format("{}, vertex normals, turned and then scaled", method.label), vertexAngles(m, method.method)});
        figure.measures.push_back({fmt::format("{}, vertex normals, scaled 1 : 1 : 4", method.label),
                                   vertexAngles(scaled(1, 1, 4), method.method)});
        heats.push_back({std::string(method.file) + "-error", std::string(method.label) + ": error",
                         "Black 0, blue 0.5, green 2, yellow 5, red 15, white 45 degrees.", std::move(c.heat)});
    }
    addError(figure, 0, "rotation only, as drawn");
    addError(figure, 1, "scale undone, as drawn");
    figure.panels.insert(figure.panels.end(), heats.begin(), heats.end());
    figure.sliders = {{0, 2}, {1, 2}};
    figure.overview = {0, 2};
    return figure;
}

} // namespace cotan::figures
