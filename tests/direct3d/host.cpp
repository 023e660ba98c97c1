// Microsoft's compilers of HLSL, and Direct3D 11, for tests that run it under Wine: host.exe DLLS < JOBS
// DLLS: the folder with dxcompiler.dll and d3dcompiler_47.dll. JOBS has one job per line, words separated by tabs. Each
// job prints one line, `NAME ok` or `NAME failed`, and the messages of compilers go to NAME.txt.
//   dxc NAME FILE ENTRY PROFILE OPTION...   compiles FILE to NAME.dxil by DXC
//   fxc NAME FILE ENTRY PROFILE [FLAGS]     compiles FILE to NAME.dxbc by FXC; FLAGS: more D3DCOMPILE_* as a number
//   compute NAME DXBC INPUT COUNT FLOATS    runs COUNT groups, which read the floats of INPUT as t0 and write FLOATS
//                                           floats to u0; writes them to NAME.bin
//   draw NAME VERTEX PIXEL INPUT COUNT WIDTH HEIGHT [IMAGE IMAGE_WIDTH IMAGE_HEIGHT]
//                                           draws COUNT vertices, which read the floats of INPUT as t0, and writes two
//                                           targets of four floats per pixel to NAME.bin; t1, s0: the image (RGBA, 8
//                                           bits), with mips, repeated, and an anisotropic filter
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <windows.h>
// After windows.h.
#include <d3d11.h>
#include <d3dcompiler.h>

namespace {

// ---- DXC: what mingw-w64 has no header for (dxcapi.h of Microsoft's compiler) -----------------------------

struct DxcText {
    const void* text;
    std::size_t size;
    UINT codePage; // 0: what its first bytes say, else UTF-8
};

struct DxcBlob : IUnknown {
    virtual void* STDMETHODCALLTYPE data() = 0;
    virtual std::size_t STDMETHODCALLTYPE size() = 0;
};

struct DxcResult : IUnknown {
    virtual HRESULT STDMETHODCALLTYPE status(HRESULT* status) = 0;
    virtual HRESULT STDMETHODCALLTYPE result(DxcBlob** blob) = 0;
    virtual HRESULT STDMETHODCALLTYPE messages(DxcBlob** blob) = 0;
};

struct DxcCompiler : IUnknown {
    virtual HRESULT STDMETHODCALLTYPE compile(const DxcText* source, const wchar_t** words, UINT32 count,
                                              IUnknown* includes, const IID& kind, void** result) = 0;
};

struct DxcVersion : IUnknown {
    virtual HRESULT STDMETHODCALLTYPE version(UINT32* major, UINT32* minor) = 0;
};

constexpr GUID kCompilerClass = {0x73e22d93, 0xe6ce, 0x47f3, {0xb5, 0xbf, 0xf0, 0x66, 0x4f, 0x39, 0xc1, 0xb0}};
constexpr GUID kCompiler = {0x228b4687, 0x5a6a, 0x4730, {0x90, 0x0c, 0x97, 0x02, 0xb2, 0x20, 0x3f, 0x54}};
constexpr GUID kResult = {0x58346cda, 0xdde7, 0x4497, {0x94, 0x61, 0x6f, 0x87, 0xaf, 0x5e, 0x06, 0x59}};
constexpr GUID kVersion = {0xb04f5b50, 0x2059, 0x4f12, {0xa8, 0xff, 0xa1, 0xe0, 0xcd, 0xe1, 0xcc, 0x7e}};

using CreateDxc = HRESULT(WINAPI*)(const GUID&, const GUID&, void**);

// ---- files ------------------------------------------------------------------------------------------------

std::string readFile(const std::string& name)
{
    std::ifstream stream(name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void writeFile(const std::string& name, const void* data, std::size_t size)
{
    std::ofstream(name, std::ios::binary).write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
}

UINT number(const std::string& text) { return static_cast<UINT>(std::stoul(text)); }

std::wstring wide(const std::string& text) { return {text.begin(), text.end()}; }

template<class Function> Function functionOf(const std::string& dll, const char* name)
{
    const HMODULE module = LoadLibraryA(dll.c_str());
    const auto found = module ? reinterpret_cast<void*>(GetProcAddress(module, name)) : nullptr;
    if (!found) {
        std::cerr << dll << ": no " << name << "\n";
        std::exit(2);
    }
    return reinterpret_cast<Function>(found);
}

// ---- jobs -------------------------------------------------------------------------------------------------

struct Compilers {
    DxcCompiler* dxc = nullptr;
    pD3DCompile fxc = nullptr;
};

using Words = std::vector<std::string>;

bool compileByDxc(const Compilers& compilers, const Words& job)
{
    const std::string text = readFile(job[2]);
    const DxcText source{text.data(), text.size(), 65001};
    std::vector<std::wstring> words{wide(job[2]), L"-E", wide(job[3]), L"-T", wide(job[4])};
    for (std::size_t k = 5; k < job.size(); ++k)
        words.push_back(wide(job[k]));
    std::vector<const wchar_t*> pointers;
    for (const std::wstring& word : words)
        pointers.push_back(word.c_str());
    DxcResult* result = nullptr;
    HRESULT status = compilers.dxc->compile(&source, pointers.data(), static_cast<UINT32>(pointers.size()), nullptr,
                                            kResult, reinterpret_cast<void**>(&result));
    if (FAILED(status) || !result || FAILED(result->status(&status)))
        return false;
    DxcBlob* blob = nullptr;
    if (SUCCEEDED(result->messages(&blob)) && blob)
        writeFile(job[1] + ".txt", blob->data(), blob->size());
    blob = nullptr;
    if (FAILED(status) || FAILED(result->result(&blob)) || !blob || blob->size() == 0)
        return false;
    writeFile(job[1] + ".dxil", blob->data(), blob->size());
    return true;
}

bool compileByFxc(const Compilers& compilers, const Words& job)
{
    const std::string text = readFile(job[2]);
    ID3DBlob *code = nullptr, *messages = nullptr;
    const UINT flags =
        D3DCOMPILE_ENABLE_STRICTNESS | (job.size() > 5 ? number(job[5]) : D3DCOMPILE_OPTIMIZATION_LEVEL3);
    const HRESULT status = compilers.fxc(text.data(), text.size(), job[2].c_str(), nullptr, nullptr, job[3].c_str(),
                                         job[4].c_str(), flags, 0, &code, &messages);
    if (messages)
        writeFile(job[1] + ".txt", messages->GetBufferPointer(), messages->GetBufferSize());
    if (FAILED(status) || !code)
        return false;
    writeFile(job[1] + ".dxbc", code->GetBufferPointer(), code->GetBufferSize());
    return true;
}

// ---- Direct3D 11 --------------------------------------------------------------------------------------------

// A job whose call fails has failed; the status goes to standard error.
void need(HRESULT status, const char* what)
{
    if (SUCCEEDED(status))
        return;
    std::cerr << what << ": " << std::hex << static_cast<unsigned long>(status) << std::dec << std::endl;
    throw status;
}

// Objects live until the process ends, which the jobs of one test do not make long.
struct Direct3D {
    ID3D11Device* device = nullptr;
    ID3D11DeviceContext* context = nullptr;

    Direct3D()
    {
        const D3D_FEATURE_LEVEL wanted = D3D_FEATURE_LEVEL_11_0;
        need(D3D11CreateDevice(nullptr, D3D_DRIVER_TYPE_HARDWARE, nullptr, 0, &wanted, 1, D3D11_SDK_VERSION, &device,
                               nullptr, &context),
             "D3D11CreateDevice");
    }

    ID3D11Buffer* buffer(const void* data, UINT bytes, D3D11_USAGE usage, UINT bind, UINT access) const
    {
        const D3D11_BUFFER_DESC info{bytes, usage, bind, access, bind ? UINT(D3D11_RESOURCE_MISC_BUFFER_STRUCTURED) : 0,
                                     4};
        const D3D11_SUBRESOURCE_DATA first{data, 0, 0};
        ID3D11Buffer* made = nullptr;
        need(device->CreateBuffer(&info, data ? &first : nullptr, &made), "CreateBuffer");
        return made;
    }

    ID3D11ShaderResourceView* view(ID3D11Resource* resource) const
    {
        ID3D11ShaderResourceView* made = nullptr;
        need(device->CreateShaderResourceView(resource, nullptr, &made), "CreateShaderResourceView");
        return made;
    }

    ID3D11ShaderResourceView* floats(const std::string& file) const
    {
        const std::string bytes = readFile(file);
        return view(
            buffer(bytes.data(), static_cast<UINT>(bytes.size()), D3D11_USAGE_DEFAULT, D3D11_BIND_SHADER_RESOURCE, 0));
    }

    ID3D11Texture2D* texture(UINT width, UINT height, DXGI_FORMAT format, D3D11_USAGE usage, UINT bind, UINT access,
                             UINT levels = 1) const
    {
        const D3D11_TEXTURE2D_DESC info{
            width,  height, levels, 1,      format,
            {1, 0}, usage,  bind,   access, levels == 1 ? 0 : UINT(D3D11_RESOURCE_MISC_GENERATE_MIPS)};
        ID3D11Texture2D* made = nullptr;
        need(device->CreateTexture2D(&info, nullptr, &made), "CreateTexture2D");
        return made;
    }

    void append(std::ofstream& out, ID3D11Resource* copy, UINT rows, std::size_t rowBytes) const
    {
        D3D11_MAPPED_SUBRESOURCE mapped;
        need(context->Map(copy, 0, D3D11_MAP_READ, 0, &mapped), "Map");
        for (UINT row = 0; row < rows; ++row)
            out.write(static_cast<const char*>(mapped.pData) + std::size_t(row) * mapped.RowPitch,
                      static_cast<std::streamsize>(rowBytes));
        context->Unmap(copy, 0);
    }
};

void compute(const Direct3D& d3d, const Words& job)
{
    const std::string code = readFile(job[2]);
    const UINT bytes = number(job[5]) * 4;
    ID3D11ComputeShader* shader = nullptr;
    need(d3d.device->CreateComputeShader(code.data(), code.size(), nullptr, &shader), "CreateComputeShader");
    ID3D11Buffer* out = d3d.buffer(nullptr, bytes, D3D11_USAGE_DEFAULT, D3D11_BIND_UNORDERED_ACCESS, 0);
    ID3D11UnorderedAccessView* written = nullptr;
    need(d3d.device->CreateUnorderedAccessView(out, nullptr, &written), "CreateUnorderedAccessView");
    ID3D11ShaderResourceView* input = d3d.floats(job[3]);
    d3d.context->CSSetShader(shader, nullptr, 0);
    d3d.context->CSSetShaderResources(0, 1, &input);
    d3d.context->CSSetUnorderedAccessViews(0, 1, &written, nullptr);
    d3d.context->Dispatch(number(job[4]), 1, 1);
    ID3D11Buffer* copy = d3d.buffer(nullptr, bytes, D3D11_USAGE_STAGING, 0, D3D11_CPU_ACCESS_READ);
    d3d.context->CopyResource(copy, out);
    std::ofstream file(job[1] + ".bin", std::ios::binary);
    d3d.append(file, copy, 1, bytes);
}

void setImage(const Direct3D& d3d, const Words& job)
{
    const UINT width = number(job[9]), height = number(job[10]);
    const std::string texels = readFile(job[8]);
    ID3D11Texture2D* map = d3d.texture(width, height, DXGI_FORMAT_R8G8B8A8_UNORM, D3D11_USAGE_DEFAULT,
                                       D3D11_BIND_SHADER_RESOURCE | D3D11_BIND_RENDER_TARGET, 0, 0); // all levels
    d3d.context->UpdateSubresource(map, 0, nullptr, texels.data(), width * 4, 0);
    ID3D11ShaderResourceView* seen = d3d.view(map);
    d3d.context->GenerateMips(seen);
    d3d.context->PSSetShaderResources(1, 1, &seen);
    constexpr auto wrap = D3D11_TEXTURE_ADDRESS_WRAP;
    const D3D11_SAMPLER_DESC info{D3D11_FILTER_ANISOTROPIC, wrap, wrap, wrap, 0, 16, D3D11_COMPARISON_NEVER, {}, 0,
                                  D3D11_FLOAT32_MAX};
    ID3D11SamplerState* sampler = nullptr;
    need(d3d.device->CreateSamplerState(&info, &sampler), "CreateSamplerState");
    d3d.context->PSSetSamplers(0, 1, &sampler);
}

void draw(const Direct3D& d3d, const Words& job)
{
    const std::string vertexCode = readFile(job[2]), pixelCode = readFile(job[3]);
    const UINT width = number(job[6]), height = number(job[7]);
    constexpr auto colors = DXGI_FORMAT_R32G32B32A32_FLOAT;
    ID3D11VertexShader* vertex = nullptr;
    ID3D11PixelShader* pixel = nullptr;
    need(d3d.device->CreateVertexShader(vertexCode.data(), vertexCode.size(), nullptr, &vertex), "CreateVertexShader");
    need(d3d.device->CreatePixelShader(pixelCode.data(), pixelCode.size(), nullptr, &pixel), "CreatePixelShader");
    ID3D11Texture2D* targets[2];
    ID3D11RenderTargetView* views[2];
    constexpr float none[4] = {};
    for (int k = 0; k < 2; ++k) {
        targets[k] = d3d.texture(width, height, colors, D3D11_USAGE_DEFAULT, D3D11_BIND_RENDER_TARGET, 0);
        need(d3d.device->CreateRenderTargetView(targets[k], nullptr, &views[k]), "CreateRenderTargetView");
        d3d.context->ClearRenderTargetView(views[k], none);
    }
    ID3D11Texture2D* depths =
        d3d.texture(width, height, DXGI_FORMAT_D32_FLOAT, D3D11_USAGE_DEFAULT, D3D11_BIND_DEPTH_STENCIL, 0);
    ID3D11DepthStencilView* depth = nullptr;
    need(d3d.device->CreateDepthStencilView(depths, nullptr, &depth), "CreateDepthStencilView");
    d3d.context->ClearDepthStencilView(depth, D3D11_CLEAR_DEPTH, 1, 0);
    const D3D11_RASTERIZER_DESC both{D3D11_FILL_SOLID, D3D11_CULL_NONE, FALSE, 0, 0, 0, TRUE, FALSE, FALSE, FALSE};
    ID3D11RasterizerState* raster = nullptr;
    need(d3d.device->CreateRasterizerState(&both, &raster), "CreateRasterizerState");
    const D3D11_VIEWPORT viewport{0, 0, static_cast<float>(width), static_cast<float>(height), 0, 1};
    ID3D11ShaderResourceView* input = d3d.floats(job[4]);
    if (job.size() > 10)
        setImage(d3d, job);
    d3d.context->RSSetState(raster);
    d3d.context->RSSetViewports(1, &viewport);
    d3d.context->OMSetRenderTargets(2, views, depth);
    d3d.context->IASetPrimitiveTopology(D3D11_PRIMITIVE_TOPOLOGY_TRIANGLELIST);
    d3d.context->VSSetShader(vertex, nullptr, 0);
    d3d.context->VSSetShaderResources(0, 1, &input);
    d3d.context->PSSetShader(pixel, nullptr, 0);
    d3d.context->Draw(number(job[5]), 0);
    std::ofstream file(job[1] + ".bin", std::ios::binary);
    for (ID3D11Texture2D* target : targets) {
        ID3D11Texture2D* copy = d3d.texture(width, height, colors, D3D11_USAGE_STAGING, 0, D3D11_CPU_ACCESS_READ);
        d3d.context->CopyResource(copy, target);
        d3d.append(file, copy, height, std::size_t(width) * 16);
    }
}

bool done(const Compilers& compilers, const Words& job)
{
    if (job.size() >= 6 && (job[0] == "compute" || job[0] == "draw")) {
        try {
            static const Direct3D d3d; // opened by the first job that needs it
            job[0] == "draw" ? draw(d3d, job) : compute(d3d, job);
            return true;
        } catch (HRESULT) {
            return false;
        }
    }
    if (job.size() >= 5 && job[0] == "dxc")
        return compileByDxc(compilers, job);
    if (job.size() >= 5 && job[0] == "fxc")
        return compileByFxc(compilers, job);
    return false;
}

} // namespace

int main(int count, char** words)
{
    if (count != 2)
        return 1;
    const std::string dlls = words[1];
    Compilers compilers;
    compilers.fxc = functionOf<pD3DCompile>(dlls + "/d3dcompiler_47.dll", "D3DCompile");
    const auto create = functionOf<CreateDxc>(dlls + "/dxcompiler.dll", "DxcCreateInstance");
    if (FAILED(create(kCompilerClass, kCompiler, reinterpret_cast<void**>(&compilers.dxc))))
        return 2;
    DxcVersion* version = nullptr;
    UINT32 major = 0, minor = 0;
    if (SUCCEEDED(compilers.dxc->QueryInterface(kVersion, reinterpret_cast<void**>(&version))))
        version->version(&major, &minor);
    std::cout << "DXC " << major << "." << minor << std::endl;
    std::string line;
    while (std::getline(std::cin, line)) {
        std::istringstream stream(line);
        Words job;
        for (std::string word; std::getline(stream, word, '\t');)
            job.push_back(word);
        std::cout << (job.size() > 1 ? job[1] : line) << (done(compilers, job) ? " ok" : " failed") << std::endl;
    }
}
