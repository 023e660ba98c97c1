// Coloured transmittance, for the tests of both renderers.
#pragma once

#include "layered_scenes.hpp"

namespace cotan::layers {

// Panes that nothing lights and that reflect nothing: only what they let through of what is behind is seen, tinted, in
// the order of distance among blended ones; alpha counts what passes of white light.
inline void transmissiveLayersTintWhatIsBehind(const Draw& draw)
{
    struct Layer {
        glm::vec4 color; // alpha counts where the pane is blended
        bool transmits;
        AlphaMode mode;
    };
    const Layer nearestFirst[] = {{{0.9f, 0.5f, 0.2f, 1}, true, AlphaMode::opaque},
                                  {{0.1f, 0.2f, 0.9f, 0.25f}, false, AlphaMode::blend},
                                  {{0.3f, 0.8f, 0.7f, 0.5f}, true, AlphaMode::blend},
                                  {{0.6f, 0.9f, 0.4f, 0.75f}, true, AlphaMode::mask},
                                  {{0.8f, 0.7f, 0.9f, 0.3f}, false, AlphaMode::blend}};
    for (const bool wall : {false, true})
        for (const int samples : {1, 4}) {
            Scene scene;
            glm::vec3 light(0), through(1);
            for (const int k : {3, 0, 4, 2, 1}) {
                const Layer& layer = nearestFirst[k];
                Pane pane;
                pane.corner.z = float(-k);
                pane.color = layer.color;
                Material& m = scene.materials[std::size_t(addPane(scene, pane, layer.mode))];
                m.unlit = !layer.transmits;
                m.metallic = 0;
                m.transmission.strength = layer.transmits ? 1.0f : 0.0f;
                m.specular.strength = 0;
            }
            for (const Layer& layer : nearestFirst) {
                const float alpha = layer.mode == AlphaMode::blend ? layer.color.w : 1.0f;
                if (layer.transmits) {
                    through *= glm::vec3(layer.color) * alpha + (1 - alpha);
                } else {
                    light += through * glm::vec3(layer.color) * alpha;
                    through *= 1 - alpha;
                }
            }
            float passing = (through.x + through.y + through.z) / 3;
            if (wall) {
                Pane behind;
                behind.corner.z = -9;
                behind.color = {0.5f, 0.6f, 0.7f, 1};
                addPane(scene, behind, AlphaMode::opaque);
                light += through * glm::vec3(behind.color);
                passing = 0;
            }
            const Image image = draw(scene, flatView(samples));
            expectNear(at(image, 32, 16), glm::vec4(light, 1 - passing), wall ? "before a wall" : "before nothing");
            View view = flatView();
            view.output = Output::depth; // vectors are those of the nearest surface
            EXPECT_NEAR(at(draw(scene, view), 32, 16).x, 50, 1e-4f);
        }
}

} // namespace cotan::layers
