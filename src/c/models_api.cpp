// cotan.h: models and images in memory.
#include "meshes.hpp"

#include "image_views.hpp"
#include "scene/geometry.hpp"

using namespace cotan;
using namespace cotan::c;

void cotan_model_free(cotan_model* model) { delete model; }

const char* cotan_model_warnings(const cotan_model* model) { return model ? model->warnings.c_str() : ""; }

cotan_status cotan_model_up(cotan_model* model, const char* up, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        require(model, "model: expected one, found null");
        constexpr Named<bool> kIsZUp[] = {{"y", false}, {"z", true}};
        if (valueOf(kIsZUp, word(up, "up"), "up"))
            rotateZUpToYUp(model->scene);
    });
}

cotan_status cotan_model_of_meshes(size_t count, const cotan_mesh* const* meshes, const char* const* names,
                                   cotan_model** model, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        require(model && (meshes || count == 0), "meshes and model: expected both, found null");
        std::vector<Mesh> made;
        for (std::size_t i = 0; i < count; ++i) {
            const bool named = names && names[i] && *names[i] != '\0';
            const std::string name = named ? names[i] : "meshes[" + std::to_string(i) + "]";
            Mesh mesh = meshOf(checkedMesh(meshes[i], name.c_str(), /*needsUv*/ false, /*needsNormals*/ false));
            if (named)
                mesh.name = name;
            if (mesh.normals.empty())
                generateNormals(mesh);
            made.push_back(std::move(mesh));
        }
        const std::string name = made.empty() || made[0].name.empty() ? "meshes" : made[0].name;
        *model = new cotan_model{sceneOf(std::move(made), name), {}};
    });
}

void cotan_image_free(cotan_image* image) { delete image; }

cotan_status cotan_image_pixels(const cotan_image* image, cotan_image_view* view, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        require(image, "image: expected one, found null");
        checked(view, "view");
        *view = imageViewOf(image->image);
    });
}
