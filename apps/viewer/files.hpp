// Files that the viewer opens: what they are, their neighbours, whether they have changed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

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

// Tells when a file has changed and then rested for a moment, so that half of it is not read.
class Watch {
public:
    void on(const std::filesystem::path& file);
    // seconds: of any clock that goes on.
    bool changed(double seconds);

private:
    struct Look {
        std::filesystem::file_time_type time;
        std::uintmax_t bytes = 0;
        friend bool operator==(const Look&, const Look&) = default;
    };
    static std::optional<Look> lookAt(const std::filesystem::path& file);

    std::filesystem::path file_;
    std::optional<Look> known_, last_;
    double lookedAt_ = -1, sinceLast_ = 0;
};

} // namespace cotan::viewer
