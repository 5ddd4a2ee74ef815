// A page that is opened from disk gets no worker from its browser: the search runs in a hidden frame instead.
if (location.protocol === "file:") {
  window.Worker = class extends EventTarget {
    constructor(url) {
      super();
      const frame = document.body.appendChild(Object.assign(document.createElement("iframe"), { hidden: true }));
      const inside = frame.contentWindow;
      addEventListener("message", ({ source, data }) => {
        if (source === inside) this.dispatchEvent(new MessageEvent("message", { data }));
      });
      frame.contentDocument.write("<script>postMessage = (data) => parent.postMessage(data, \"*\")</script>"
        + `<script src="${url}"></script>`);
      const ready = new Promise((go) => { inside.onload = go; });
      frame.contentDocument.close();
      this.postMessage = async (data) => {
        await ready;
        inside.dispatchEvent(new MessageEvent("message", { data }));
      };
    }
  };
}
