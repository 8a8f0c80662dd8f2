#include "viewer/platform/gl.h"

#include <string>

namespace etendue::viewer {

bool Gl::load(const Loader& loader) {
  bool complete = true;
  const auto get = [&](auto& function, const char* name) {
    using Pointer = std::remove_reference_t<decltype(function)>;
    function = reinterpret_cast<Pointer>(loader((std::string("gl") + name).c_str()));
    complete = complete && function != nullptr;
  };
#define ETENDUE_GET(NAME) get(NAME, #NAME)
  ETENDUE_GET(GetString);
  ETENDUE_GET(Viewport);
  ETENDUE_GET(Clear);
  ETENDUE_GET(ClearColor);
  ETENDUE_GET(Disable);
  ETENDUE_GET(Enable);
  ETENDUE_GET(Scissor);
  ETENDUE_GET(Finish);
  ETENDUE_GET(ReadPixels);
  ETENDUE_GET(PixelStorei);
  ETENDUE_GET(GenTextures);
  ETENDUE_GET(DeleteTextures);
  ETENDUE_GET(BindTexture);
  ETENDUE_GET(ActiveTexture);
  ETENDUE_GET(TexImage2D);
  ETENDUE_GET(TexSubImage2D);
  ETENDUE_GET(TexParameteri);
  ETENDUE_GET(GenFramebuffers);
  ETENDUE_GET(DeleteFramebuffers);
  ETENDUE_GET(BindFramebuffer);
  ETENDUE_GET(FramebufferTexture2D);
  ETENDUE_GET(CheckFramebufferStatus);
  ETENDUE_GET(BlitFramebuffer);
  ETENDUE_GET(GenVertexArrays);
  ETENDUE_GET(DeleteVertexArrays);
  ETENDUE_GET(BindVertexArray);
  ETENDUE_GET(DrawArrays);
  ETENDUE_GET(CreateShader);
  ETENDUE_GET(ShaderSource);
  ETENDUE_GET(CompileShader);
  ETENDUE_GET(GetShaderiv);
  ETENDUE_GET(GetShaderInfoLog);
  ETENDUE_GET(DeleteShader);
  ETENDUE_GET(CreateProgram);
  ETENDUE_GET(AttachShader);
  ETENDUE_GET(LinkProgram);
  ETENDUE_GET(GetProgramiv);
  ETENDUE_GET(DeleteProgram);
  ETENDUE_GET(UseProgram);
  ETENDUE_GET(GetUniformLocation);
  ETENDUE_GET(Uniform1i);
  ETENDUE_GET(Uniform1f);
  ETENDUE_GET(Uniform2f);
  ETENDUE_GET(Uniform3fv);
#undef ETENDUE_GET
  return complete;
}

}  // namespace etendue::viewer
