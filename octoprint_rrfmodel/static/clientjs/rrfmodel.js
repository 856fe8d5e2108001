/* OctoPrint.plugins.rrfmodel: the plugin's endpoints for the page and for other plugins. */
(function (global, factory) {
	if (typeof define === "function" && define.amd) {
		define(["OctoPrintClient"], factory);
	} else {
		factory(global.OctoPrintClient);
	}
})(this, function (OctoPrintClient) {
	class RrfModelClient {
		constructor(base) {
			this.base = base;
			this.url = base.getBlueprintUrl("rrfmodel");
		}

		/** Resolves to the plugin's state. */
		getStatus(opts) {
			return this.base.get(this.url + "status", opts);
		}

		/** Resolves to what M409 answers to the key and flags, from the cached model. */
		getModel(key, flags, opts) {
			const query = $.param({key: key || "", flags: flags || ""});
			return this.base.get(this.url + "model?" + query, opts);
		}

		/** Resolves to what is kept for charts, since a time of the server or all of it. */
		getHistory(since, opts) {
			const query = since === undefined ? "" : "?" + $.param({since: since});
			return this.base.get(this.url + "history" + query, opts);
		}

		/** Resolves to the last prints and how they ended, the latest first. */
		getJobs(opts) {
			return this.base.get(this.url + "jobs", opts);
		}

		/** Resolves to what was said on the line lately, with a number what came behind that line. */
		getConsole(since, opts) {
			return this.base.get(this.url + "console?" + $.param({since: since || 0}), opts);
		}

		/** Sends G-code, a command a line; rejects with its reason in `responseJSON.error`. */
		script(text, opts) {
			const body = {script: text};
			return this.base.postJson(this.url + "printer/gcode/script", body, opts);
		}

		/** Resolves to unit and meaning of the model's values, by path with [] for any element. */
		getMeanings(opts) {
			return this.base.get(this.url + "meanings", opts);
		}

		/** Resolves to the entries of a folder of the machine's card. */
		getFiles(path, opts) {
			return this.base.get(this.url + "files?" + $.param({path: path}), opts);
		}

		/** Resolves to the mesh with its points; rejects where there is none. */
		getHeightmap(opts) {
			return this.base.get(this.url + "heightmap", opts);
		}

		/** Resolves to what is to be set up in OctoPrint for the machine. */
		getSetup(opts) {
			return this.base.get(this.url + "setup", opts);
		}

		/** Sends a command to the plugin; rejects with its reason in `responseJSON.error`. */
		command(name, parameters, opts) {
			return this.base.simpleApiCommand("rrfmodel", name, parameters || {}, opts);
		}
	}

	OctoPrintClient.registerPluginComponent("rrfmodel", RrfModelClient);
	return RrfModelClient;
});
