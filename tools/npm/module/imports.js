// For emscripten's linker: what src/engine.ts gives to the module.
mergeInto(LibraryManager.library, {
  progress: function () {},
  shortest_digits: function () {},
});
