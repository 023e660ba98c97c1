// KTX 2.0 files written from first principles (Khronos' specification, version 2.0.4).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "webp_maker.hpp" // little()

namespace cotan::test {

struct Ktx2Level {
    std::string stored;
    std::uint64_t plainBytes = 0;
};

struct Ktx2File {
    std::uint32_t format = 37; // VkFormat: R8G8B8A8_UNORM
    std::uint32_t width = 1, height = 1, depth = 0, layers = 0, faces = 1;
    std::uint32_t packing = 0; // supercompression scheme
    std::vector<Ktx2Level> levels = {};
    std::vector<std::string> keys = {}; // each key with its terminating zero and its value
    int colourModel = 1;                // RGBSDA
    int levelCount = -1;                // -1: the number of `levels`
    std::vector<int> channelTypes = {}; // of the descriptor's samples
    std::string global = {};            // data of the supercompression
};

inline std::string makeKtx2(const Ktx2File& k)
{
    const std::uint64_t block = 24 + 16 * k.channelTypes.size();
    std::string descriptor = little(4 + block, 4) + little(0, 4) + little(2, 2) + little(block, 2) + char(k.colourModel)
        + std::string(15, '\0');
    for (const int type : k.channelTypes)
        descriptor += little(0, 3) + char(type) + little(0, 4) + little(0, 8);
    std::string keys;
    for (const std::string& key : k.keys)
        keys += little(key.size(), 4) + key + std::string((4 - key.size() % 4) % 4, '\0');
    const std::uint64_t descriptorAt = 80 + 24 * k.levels.size(), keysAt = descriptorAt + descriptor.size();
    const std::uint64_t globalAt = keysAt + keys.size();
    const std::uint64_t at = globalAt + k.global.size();
    std::string file = "\xabKTX 20\xbb\r\n\x1a\n" + little(k.format, 4) + little(1, 4) + little(k.width, 4)
        + little(k.height, 4) + little(k.depth, 4) + little(k.layers, 4) + little(k.faces, 4)
        + little(k.levelCount < 0 ? k.levels.size() : std::uint64_t(k.levelCount), 4) + little(k.packing, 4)
        + little(descriptorAt, 4) + little(descriptor.size(), 4) + little(keysAt, 4) + little(keys.size(), 4)
        + little(k.global.empty() ? 0 : globalAt, 8) + little(k.global.size(), 8);
    std::string data;
    for (const Ktx2Level& level : k.levels) {
        file += little(at + data.size(), 8) + little(level.stored.size(), 8)
            + little(level.plainBytes > 0 ? level.plainBytes : level.stored.size(), 8);
        data += level.stored;
    }
    return file + descriptor + keys + k.global + data;
}

} // namespace cotan::test
