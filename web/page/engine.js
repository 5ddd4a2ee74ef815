// The engine: in a worker, so that the page never waits for it; in the page itself where a browser gives it no worker.

/** Answers what the page asks. The worker runs its text: it uses nothing but `wasm_bindgen`. */
function answers() {
  let [run, shown] = [null, 0];
  const of = (number, ask) => (number === shown ? ask() : null);
  const drawn = (picture) => {
    const { svg, greatest } = picture;
    picture.free();
    return { svg, greatest };
  };
  return {
    load: (module) => wasm_bindgen({ module_or_path: module }).then(() => true),
    /** All that is shown of a scene at once; later questions name it by its number. */
    solve(number, text, milliseconds) {
      const fresh = new wasm_bindgen.Run(text, milliseconds);
      try {
        const found = {
          number, strain: fresh.strain(), end: fresh.end(), events: fresh.events(),
          parameters: fresh.parameters(), contacts: fresh.contacts(), ending: fresh.ending(),
          doubts: fresh.doubts(), span: fresh.span(),
        };
        run?.free();
        [run, shown] = [fresh, number];
        return found;
      } catch (error) {
        fresh.free();
        throw error;
      }
    },
    at: (number, time, ...look) => of(number, () => ({ values: run.at(time), rod: run.rod(time, ...look) })),
    screen: (number, ...rest) => of(number, () => drawn(run.screen(...rest))),
    page: (number, ...span) => of(number, () => drawn(run.page(...span))),
  };
}

/** What the worker runs after the glue. */
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
  /** Unpacks the module and starts. */
  async load(packed, glue) {
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    const module = await new Response(stream).arrayBuffer();
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

  /** A promise of the answer; null for a scene that is no longer the last one solved. */
  ask(what, ...values) {
    if (this.worker) {
      return new Promise((take, refuse) => {
        const id = (this.asked = (this.asked ?? 0) + 1);
        this.waiting.set(id, [take, refuse]);
        this.worker.postMessage([id, what, values]);
      });
    }
    // Frames are drawn in between.
    return new Promise((take) => setTimeout(take)).then(() => this.here[what](...values)).catch((error) => {
      throw { message: error.message, failed: error instanceof WebAssembly.RuntimeError };
    });
  }
}
