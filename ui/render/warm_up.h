// What a driver does once, done before anybody waits for it.
#pragma once

namespace marsview {

class TerrainRenderer;

/// Draws a small terrain into its own frame buffer, in motion and at rest. In software the
/// first picture with a program makes machine code of it and the first texture of an array is
/// cleared: a tenth of a second, which would add to that of opening a map. Needs the renderer's
/// context current, and leaves the renderer without layers.
void warmUp(TerrainRenderer& renderer);

} // namespace marsview
