// What takes seconds, beside the page. The page ends a worker to cancel its work.

let instance;

onmessage = async ({ data: { module, call, options, file } }) => {
  try {
    instance ??= await Instance.of(module, (doing, part) => postMessage({ doing, part }));
    instance.call(call, instance.write(options, file));
    const done = { call, answer: instance.json() };
    if (call === "build") {
      done.blob = instance.part(Part.blob);
      done.mesh = instance.surface(Part.mesh);
      done.hull = instance.surface(Part.hull);
    }
    postMessage(done);
  } catch (error) {
    postMessage({ call, failed: error.message });
  }
};
