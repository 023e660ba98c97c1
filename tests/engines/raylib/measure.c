// Draws a model with a shader into images of floats: measure MODEL VERTEX FRAGMENT OUT PARTS TANGENTS
// The shader gets `part`, 0 to PARTS - 1. PARTS 0: one lit image of bytes, RGB. TANGENTS: 1 makes those of raylib.
#include <raylib.h>
#include <rlgl.h>
#include <stdio.h>
#include <stdlib.h>

int main(int count, char** words)
{
    if (count != 7)
        return 1;
    const int width = 768, height = 384, parts = atoi(words[5]);
    InitWindow(width, height, "measure");
    Model model = LoadModel(words[1]);
    Shader shader = LoadShader(words[2], words[3]);
    if (model.meshCount != 2 || !IsShaderValid(shader) || shader.id == rlGetShaderIdDefault())
        return 2;
    for (int i = 0; i < model.meshCount; ++i) {
        if (model.meshes[i].tangents)
            return 3;
        if (atoi(words[6]))
            GenMeshTangents(&model.meshes[i]);
        Material* material = &model.materials[model.meshMaterial[i]];
        Texture2D* map = &material->maps[MATERIAL_MAP_NORMAL].texture;
        GenTextureMipmaps(map);
        SetTextureFilter(*map, TEXTURE_FILTER_TRILINEAR);
        SetTextureFilter(*map, TEXTURE_FILTER_ANISOTROPIC_16X);
        material->shader = shader;
    }
    RenderTexture2D target = LoadRenderTexture(width, height);
    if (parts > 0) {
        unsigned floats = rlLoadTexture(NULL, width, height, PIXELFORMAT_UNCOMPRESSED_R32G32B32A32, 1);
        rlFramebufferAttach(target.id, floats, RL_ATTACHMENT_COLOR_CHANNEL0, RL_ATTACHMENT_TEXTURE2D, 0);
        target.texture = (Texture2D){floats, width, height, 1, PIXELFORMAT_UNCOMPRESSED_R32G32B32A32};
    }
    if (!rlFramebufferComplete(target.id))
        return 4;
    FILE* file = fopen(words[4], "wb");
    Camera3D camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 30, CAMERA_PERSPECTIVE};
    for (int part = 0; part < (parts ? parts : 1); ++part) {
        SetShaderValue(shader, GetShaderLocation(shader, "part"), &part, SHADER_UNIFORM_INT);
        BeginTextureMode(target);
        ClearBackground(BLANK);
        rlDisableColorBlend();
        BeginMode3D(camera);
        DrawModel(model, (Vector3){0, 0, 0}, 1, WHITE);
        EndMode3D();
        EndTextureMode();
        Image image = LoadImageFromTexture(target.texture);
        ImageFlipVertical(&image);
        if (parts == 0)
            ImageFormat(&image, PIXELFORMAT_UNCOMPRESSED_R8G8B8);
        fwrite(image.data, parts ? 16 : 3, width * height, file);
    }
    fclose(file);
    printf("raylib %s\nDONE\n", RAYLIB_VERSION);
    return 0;
}
