// The engine runs in a worker, so that the page stays free; in the page itself if the browser allows no worker.

/** Returns the functions that answer the page. The worker runs their source text: it may use only `wasm_bindgen`. */
function answers() {
  // The run that gives the numbers, the one that is drawn, and the number of their scene.
  let [run, canvas, shown] = [null, null, 0];
  const ifShown = (number, ask) => (number === shown ? ask() : null);
  const drawn = (picture) => {
    const { svg, colorLimit } = picture;
    picture.free();
    return { svg, colorLimit };
  };
  return {
    load: (module) => wasm_bindgen({ module_or_path: module }).then(() => true),
    /**
     * Solves a scene and returns all that is shown at once; later questions name the scene by its number. Longer
     * numbers draw it only if doubles have not: they take a hundred times as long.
     */
    solve(number, text, milliseconds, longer) {
      const fresh = new wasm_bindgen.Run(text, milliseconds, longer);
      try {
        const found = {
          number, strain: fresh.strain(), end: fresh.end(), events: fresh.events(),
          parameters: fresh.parameters(), contacts: fresh.contacts(), ending: fresh.ending(),
          doubts: fresh.doubts(), span: fresh.span(),
        };
        const kept = longer && number === shown + 1 ? canvas : fresh;
        for (const old of new Set([run, canvas])) if (old !== kept) old?.free();
        [run, canvas, shown] = [fresh, kept, number];
        return found;
      } catch (error) {
        fresh.free();
        throw error;
      }
    },
    /** Solves a chain and returns all that is shown of it: a picture for the screen, or for a page without a size. */
    chain(text, ...size) {
      const stack = new wasm_bindgen.Stack(text);
      const svg = size.length ? stack.screen(...size) : stack.page();
      const found = { svg, contacts: stack.contacts(), end: stack.end() };
      stack.free();
      return found;
    },
    at: (number, time, ...look) => ifShown(number, () => ({ values: run.at(time), rod: canvas.rod(time, ...look) })),
    screen: (number, ...rest) => ifShown(number, () => drawn(canvas.screen(...rest))),
    page: (number, ...span) => ifShown(number, () => drawn(canvas.page(...span))),
  };
}

/** Answers the messages of the page; the worker runs it after the glue. */
function serve() {
  const here = answers();
  onmessage = async ({ data: [id, what, values] }) => {
    try {
      postMessage([id, await here[what](...values)]);
    } catch (error) {
      postMessage([id, null, { message: error.message, failed: error instanceof WebAssembly.RuntimeError }]);
    }
  };
}

export class Engine {
  /** Starts the worker with the module. */
  async load(module, glue) {
    try {
      this.waiting = new Map();
      const text = [glue, answers, `(${serve})()`].join("\n");
      this.worker = new Worker(URL.createObjectURL(new Blob([text], { type: "text/javascript" })));
      const refused = new Promise((_, refuse) => { this.worker.onerror = refuse; });
      this.worker.onmessage = ({ data: [id, answer, error] }) => {
        const [take, refuse] = this.waiting.get(id);
        this.waiting.delete(id);
        if (error) refuse(error);
        else take(answer);
      };
      await Promise.race([this.ask("load", module), refused]);
    } catch {
      [this.worker, this.here] = [null, answers()];
      await this.here.load(module);
    }
  }

  /** Returns a promise of the answer, which is null if another scene has been solved meanwhile. */
  ask(what, ...values) {
    if (this.worker) {
      return new Promise((take, refuse) => {
        const id = (this.asked = (this.asked ?? 0) + 1);
        this.waiting.set(id, [take, refuse]);
        this.worker.postMessage([id, what, values]);
      });
    }
    // The timeout lets the browser draw a frame.
    return new Promise((take) => setTimeout(take)).then(() => this.here[what](...values)).catch((error) => {
      throw { message: error.message, failed: error instanceof WebAssembly.RuntimeError };
    });
  }
}
