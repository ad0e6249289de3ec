// The worker: builds and measures, which takes seconds or minutes, on a thread of its own. The page
// ends the worker to cancel.

let instance;

onmessage = async ({ data: { module, call, options, file } }) => {
  try {
    instance ??= await Instance.of(module, (stage, fraction) => postMessage({ stage, fraction }));
    instance.call(call, instance.write(options, file));
    const done = { answer: instance.json() };
    if (call === "build") {
      done.blob = instance.part(Part.blob);
      done.mesh = instance.surface(Part.mesh);
      done.hull = instance.surface(Part.hull);
    }
    const surfaces = [done.mesh, done.hull].filter((surface) => surface);
    const arrays = surfaces.flatMap(({ vertices, triangles }) => [vertices, triangles]);
    if (done.blob) arrays.push(done.blob);
    // Without a copy.
    postMessage(done, arrays.map(({ buffer }) => buffer));
  } catch (error) {
    postMessage({ failed: error.message });
  }
};
