// Tests for both renderers: coloured transmittance, and edges of alpha masks.
#pragma once

#include "layered_scenes.hpp"

namespace cotan::layers {

// Unlit panes without reflection show only the tinted light from behind. Blended panes are sorted by distance; alpha is
// the fraction of white light that is blocked.
inline void transmissiveLayersTintLayersBehindThem(const Draw& draw)
{
    struct Layer {
        glm::vec4 color; // alpha applies if the pane is blended
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
            glm::vec3 light(0), transmittance(1);
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
                    transmittance *= glm::vec3(layer.color) * alpha + (1 - alpha);
                } else {
                    light += transmittance * glm::vec3(layer.color) * alpha;
                    transmittance *= 1 - alpha;
                }
            }
            float passing = (transmittance.x + transmittance.y + transmittance.z) / 3;
            if (wall) {
                Pane behind;
                behind.corner.z = -9;
                behind.color = {0.5f, 0.6f, 0.7f, 1};
                addPane(scene, behind, AlphaMode::opaque);
                light += transmittance * glm::vec3(behind.color);
                passing = 0;
            }
            const Image image = draw(scene, flatView(samples));
            expectNear(at(image, 32, 16), glm::vec4(light, 1 - passing), wall ? "before a wall" : "before nothing");
            View view = flatView();
            view.output = Output::depth; // vectors come from the nearest surface
            EXPECT_NEAR(at(draw(scene, view), 32, 16).x, 50, 1e-4f);
        }
}

// The edge of a mask covers individual samples, like the edge of a triangle. Vectors and single-sample images are kept
// or dropped as a whole. Alpha is a plane that is 0.5 along x = 0.25 y + `edge`.
inline void masksCoverTheSamplesOnTheirSide(const Draw& draw)
{
    const glm::vec2 sampleOffsets[] = {{-0.125f, -0.375f}, {0.375f, -0.125f}, {-0.375f, 0.125f}, {0.125f, 0.375f}};
    for (const float edge : {0.0f, 0.3f, 0.55f}) {
        Scene scene;
        Pane pane;
        pane.corner = {-20, 10, 0};
        const int material = addPane(scene, pane, AlphaMode::mask);
        scene.materials[std::size_t(material)].alphaCutoff = 0.5f;
        const auto side = [&](float x, float y) { return x - 0.25f * y - edge; };
        for (std::size_t i = 0; i < 4; ++i) {
            const glm::vec3 p = scene.meshes[0].positions[i];
            scene.meshes[0].colors[i].w = 0.5f + side(p.x, p.y) / 64;
        }
        const Image four = draw(scene, flatView(4)), one = draw(scene, flatView(1));
        View view = flatView(4);
        view.output = Output::normal;
        const Image normals = draw(scene, view);
        int partly = 0;
        for (int y = 8; y < 24; ++y)
            for (int x = 25; x < 39; ++x) {
                const float cx = float(x) - 31.5f, cy = 15.5f - float(y);
                float covered = 0;
                for (const glm::vec2& offset : sampleOffsets)
                    covered += side(cx + offset.x, cy - offset.y) >= 0 ? 0.25f : 0.0f;
                bool close = std::abs(side(cx, cy)) < 1e-3f;
                for (const glm::vec2& offset : sampleOffsets)
                    close = close || std::abs(side(cx + offset.x, cy - offset.y)) < 1e-3f;
                if (close)
                    continue; // rounding decides
                const float whole = side(cx, cy) >= 0 ? 1.0f : 0.0f;
                EXPECT_EQ(at(four, x, y).w, covered) << x << " " << y << ", edge " << edge;
                EXPECT_EQ(at(one, x, y).w, whole) << x << " " << y << ", edge " << edge;
                EXPECT_EQ(at(normals, x, y).w, whole) << x << " " << y << ", edge " << edge;
                partly += covered > 0 && covered < 1;
            }
        EXPECT_GT(partly, 4) << edge;
    }
}

} // namespace cotan::layers
