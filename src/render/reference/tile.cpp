#include "tile.hpp"

#include <algorithm>

namespace cotan::reference {

Tile::Tile(Rectangle area, const SamplePattern& pattern)
    : area_(area), pattern_(pattern), samples_(std::size_t(pattern.count))
{
    std::size_t count = std::size_t(area.x1 - area.x0) * std::size_t(area.y1 - area.y0) * samples_;
    value_.assign(count, glm::vec4(0));
    reversedDepth_.assign(count, -1.0f);
}

std::size_t Tile::at(int x, int y) const
{
    std::size_t pixel = std::size_t(y - area_.y0) * std::size_t(area_.x1 - area_.x0) + std::size_t(x - area_.x0);
    return pixel * samples_;
}

// Nearness at a sample. Rounded to float as a depth buffer is, so that equal surfaces tie and the first one drawn
// stays.
float Tile::reversedDepthAt(const Plane& z, int x, int y, std::size_t sample) const
{
    const glm::ivec2 offset = pattern_.offset[sample];
    return float(z.at(x + offset.x / double(kSubPixels), y + offset.y / double(kSubPixels)));
}

void Tile::expect(int x, int y, unsigned covered, const Plane& z)
{
    if (expected_.empty())
        expected_.assign(reversedDepth_.size(), -1.0f);
    for (std::size_t s = 0; s < samples_; ++s)
        if (covered >> s & 1) {
            float& nearest = expected_[at(x, y) + s];
            nearest = std::max(nearest, reversedDepthAt(z, x, y, s));
        }
}

unsigned Tile::nearer(int x, int y, unsigned covered, const Plane& z) const
{
    const std::size_t first = at(x, y);
    unsigned passed = 0;
    for (std::size_t s = 0; s < samples_; ++s) {
        if (!(covered >> s & 1))
            continue;
        const float depth = reversedDepthAt(z, x, y, s);
        if (depth > reversedDepth_[first + s] && (expected_.empty() || depth >= expected_[first + s]))
            passed |= 1u << s;
    }
    return passed;
}

void Tile::write(int x, int y, unsigned samples, glm::vec4 value, const Plane& z)
{
    ++written_;
    for (std::size_t s = 0; s < samples_; ++s) {
        if (!(samples >> s & 1))
            continue;
        value_[at(x, y) + s] = value;
        reversedDepth_[at(x, y) + s] = reversedDepthAt(z, x, y, s);
    }
}

void Tile::blend(int x, int y, unsigned samples, glm::vec4 value, glm::vec3 through, const Plane& z)
{
    if (layers_.size() == kMaxLayers)
        throw TooManyLayers{};
    if (newest_.empty())
        newest_.assign(value_.size() / samples_, kNone);
    std::uint32_t& newest = newest_[at(x, y) / samples_];
    Layer layer{glm::vec3(value) * value.w, through, {}, samples, newest};
    for (std::size_t s = 0; s < samples_; ++s)
        layer.reversedDepth[s] = reversedDepthAt(z, x, y, s);
    newest = std::uint32_t(layers_.size());
    layers_.push_back(layer);
}

std::vector<const Tile::Layer*> Tile::layersOf(std::size_t pixel) const
{
    std::vector<const Layer*> layers;
    for (std::uint32_t i = newest_.empty() ? kNone : newest_[pixel]; i != kNone; i = layers_[i].before)
        layers.push_back(&layers_[i]);
    return layers;
}

void Tile::clear(int x, int y, glm::vec4 value)
{
    for (std::size_t s = 0; s < samples_; ++s)
        value_[at(x, y) + s] = value;
}

glm::vec4 Tile::resolve(int x, int y) const
{
    glm::vec4 sum(0);
    std::vector<const Layer*> layers = layersOf(at(x, y) / samples_);
    for (std::size_t s = 0; s < samples_; ++s) {
        // Their addresses are in the order in which they were added.
        std::sort(layers.begin(), layers.end(), [&](const Layer* a, const Layer* b) {
            return a->reversedDepth[s] != b->reversedDepth[s] ? a->reversedDepth[s] < b->reversedDepth[s] : a < b;
        });
        glm::vec3 light(value_[at(x, y) + s]), through(1);
        for (const Layer* layer : layers) // farthest first
            if (layer->samples >> s & 1) {
                light = layer->light + light * layer->through;
                through *= layer->through;
            }
        // Alpha has no colour: it counts what passes of white light.
        const float passing = (through.x + through.y + through.z) / 3;
        sum += glm::vec4(light, 1 - passing * (1 - value_[at(x, y) + s].w));
    }
    return sum / float(samples_);
}

} // namespace cotan::reference
