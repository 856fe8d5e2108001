/* What macros write for Duet Web Control: a few tags of HTML, made of elements, never parsed as HTML. */
$(function () {
	const TAG = /<(\/?)([a-z][a-z0-9]*)((?:\s[^<>]*)?)\/?>/gi;
	const HREF = /\shref\s*=\s*(?:"([^"]*)"|'([^']*)'|([^\s"'>]+))/i;
	const ENTITY = /&(?:#(\d{1,7})|#x([0-9a-f]{1,6})|([a-z]+));/gi;
	const ENTITIES = new Map(
		Object.entries({amp: "&", lt: "<", gt: ">", quot: '"', apos: "'", nbsp: "\u00a0", deg: "°"})
	);
	const LAST_CHARACTER = 0x10ffff;

	/** Tags that become an element, without anything of what was written in them. */
	const SHOWN = {b: "b", strong: "b", i: "i", em: "i"};
	const LINK = "a";
	const PROTOCOLS = ["http:", "https:"];
	/** Tags that stand for a new line, at their beginning or, of those that go around it, their end. */
	const BREAK = "br";
	const BLOCKS = ["p", "div", "li", "tr", "h1", "h2", "h3", "h4", "h5", "h6"];
	/** What else is HTML is left out; `<filename>` and `a < b` are what somebody wrote. */
	const DROPPED =
		"ul ol table tbody thead td th span font u s small big sub sup code pre center hr img svg " +
		"audio video source iframe object embed form input button script style link meta base html " +
		"head body title blockquote label mark del ins details summary section";
	const KNOWN = new Set([...Object.keys(SHOWN), LINK, BREAK, ...BLOCKS, ...DROPPED.split(" ")]);

	const decoded = text =>
		text.replace(ENTITY, function (all, decimal, hexadecimal, name) {
			if (name) return ENTITIES.get(name.toLowerCase()) || all;
			const code = decimal ? parseInt(decimal, 10) : parseInt(hexadecimal, 16);
			return code > 0 && code <= LAST_CHARACTER ? String.fromCodePoint(code) : all;
		});

	/** The address of a link, where it leads to a page and nowhere else. */
	const addressOf = function (attributes) {
		const found = HREF.exec(attributes);
		if (!found) return null;
		try {
			const url = new URL(decoded(found[1] || found[2] || found[3] || ""));
			return PROTOCOLS.includes(url.protocol) ? url.href : null;
		} catch (error) {
			return null;
		}
	};

	const elementOf = function (name, attributes) {
		if (name !== LINK) return document.createElement(SHOWN[name]);
		const address = addressOf(attributes);
		if (!address) return null;
		const link = document.createElement("a");
		link.href = address;
		link.target = "_blank";
		link.rel = "noopener noreferrer";
		return link;
	};

	/** Returns nodes for a text with tags: text, line breaks, bold, italic, links to pages. */
	RRFModel.markup = function (given) {
		const text = String(given);
		const root = document.createDocumentFragment();
		const open = [];
		const inner = () => (open.length ? open[open.length - 1].element : root);
		const write = part => part && inner().appendChild(document.createTextNode(decoded(part)));
		const newLine = () => root.textContent && inner().appendChild(document.createElement("br"));

		const close = function (kind) {
			const place = open.map(each => each.kind).lastIndexOf(kind);
			if (place >= 0) open.length = place;
		};
		const take = function (isEnd, name, attributes) {
			if (name === BREAK) inner().appendChild(document.createElement("br"));
			if (BLOCKS.includes(name) && isEnd) newLine();
			const kind = SHOWN[name] || (name === LINK && LINK);
			if (!kind) return;
			if (isEnd) return close(kind);
			// one in another of its kind says nothing, and so many would be too deep to draw
			if (open.some(each => each.kind === kind)) return;
			const element = elementOf(name, attributes);
			if (!element) return;
			inner().appendChild(element);
			open.push({kind, element});
		};

		let end = 0;
		for (const found of text.matchAll(TAG)) {
			const name = found[2].toLowerCase();
			if (!KNOWN.has(name)) continue;
			write(text.slice(end, found.index));
			end = found.index + found[0].length;
			take(!!found[1], name, found[3]);
		}
		write(text.slice(end));
		if (root.textContent.trim()) return root;
		// of tags alone nothing would be left
		const whole = document.createDocumentFragment();
		whole.appendChild(document.createTextNode(text));
		return whole;
	};

	/** The same without anything but text, for where one line is shown. */
	RRFModel.plainText = function (text) {
		const nodes = RRFModel.markup(text);
		nodes.querySelectorAll("br").forEach(each => each.replaceWith("\n"));
		return nodes.textContent;
	};

	/** `markup: text` shows a text of the printer's with its tags. */
	ko.bindingHandlers.markup = {
		update: function (element, valueOf) {
			element.replaceChildren(RRFModel.markup(ko.unwrap(valueOf()) || ""));
		}
	};
});
