// Files that the viewer opens: what they are, their neighbours, whether they have changed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cotan::viewer {

// By the ending: a picture, or a model. Everything else is neither.
bool isPicture(const std::filesystem::path& file);
bool isModel(const std::filesystem::path& file);

// Its name without folders.
inline std::string fileName(const std::filesystem::path& file) { return file.filename().string(); }

// The model `step` places behind this one among those of its folder, by name, around the end. Empty where there is no
// other.
std::string neighbourOf(const std::filesystem::path& file, int step);

// A file path as people paste it: without the spaces, quotes and file:// around it.
std::string pathOf(std::string text);

// Tells when one of some files has changed and then rested for a moment, so that half of it is not read.
class Watch {
public:
    // Files that were watched before go on being watched from what was seen of them last.
    void on(const std::vector<std::filesystem::path>& files);
    // Whether any has. seconds: of any clock that goes on.
    bool changed(double seconds);

private:
    struct Look {
        std::filesystem::file_time_type time;
        std::uintmax_t bytes = 0;
        friend bool operator==(const Look&, const Look&) = default;
    };
    struct File {
        std::filesystem::path path;
        std::optional<Look> known, last;
        double sinceLast = 0;
    };
    static std::optional<Look> lookAt(const std::filesystem::path& file);
    static bool changed(File& file, double seconds);

    std::vector<File> files_;
    double lookedAt_ = -1;
};

// The model and the files that it names: buffers and pictures of a .gltf; of others the pictures of these names, and
// the materials, in its folder. Those that are not there are left out.
std::vector<std::filesystem::path> filesOf(const std::filesystem::path& model,
                                           const std::vector<std::string>& pictureNames);

} // namespace cotan::viewer
