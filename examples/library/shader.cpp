// Prints the function that perturbs the normal in a fragment shader of Vulkan or OpenGL.
#include <cstdio>

#include <cotan/shader_text.hpp>

int main()
{
    using namespace cotan;
    const auto shader =
        shader_text::makeShaderText({.language = shader_text::Language::glsl, .frame = Frame::cotangent});
    if (!shader)
        return std::fprintf(stderr, "%s\n", shader.error().message.c_str()), 1;
    std::printf("%s", shader->text.c_str());
}
