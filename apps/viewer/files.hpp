// Files that the viewer opens: their kinds, their neighbours, and whether they have changed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cotan::viewer {

// Whether the file's extension is that of an image, or of a model.
bool isImageFile(const std::filesystem::path& file);
bool isModel(const std::filesystem::path& file);

// The file name without folders.
inline std::string fileName(const std::filesystem::path& file) { return file.filename().string(); }

// The model `step` positions after this one among those in its folder, sorted by name, wrapping around. Empty if there
// is no other.
std::string neighbourOf(const std::filesystem::path& file, int step);

// Cleans up a pasted file path: removes surrounding spaces and quotes, and a file:// prefix.
std::string pathOf(std::string text);

// Reports when a watched file has changed and then not changed for a moment, so that no half-written file is read.
class Watch {
public:
    // Sets the watched files. Files that were already watched keep their last known state.
    void on(const std::vector<std::filesystem::path>& files);
    // Whether any file has changed. seconds: of any clock that never goes back.
    bool changed(double seconds);

private:
    struct FileStamp {
        std::filesystem::file_time_type time;
        std::uintmax_t bytes = 0;
        friend bool operator==(const FileStamp&, const FileStamp&) = default;
    };
    struct File {
        std::filesystem::path path;
        std::optional<FileStamp> known, last;
        double sinceLast = 0;
    };
    static std::optional<FileStamp> stampOf(const std::filesystem::path& file);
    static bool changed(File& file, double seconds);

    std::vector<File> files_;
    double polledAt_ = -1;
};

// The model and the existing files it refers to: buffers and images of a .gltf; for other formats the images with these
// names and the .mtl file in its folder.
std::vector<std::filesystem::path> filesOf(const std::filesystem::path& model,
                                           const std::vector<std::string>& pictureNames);

} // namespace cotan::viewer
