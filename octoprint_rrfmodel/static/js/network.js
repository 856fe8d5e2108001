/* The connection panel of a board on the network: its address, and its password, which is kept apart. */
$(function () {
	const CONNECTOR = "rrfmodel";

	function RrfModelNetworkViewModel(parameters) {
		const self = this;
		const core = parameters[0];

		self.hosts = ko.observableArray([]);
		self.password = ko.observable("");
		self.told = ko.observable("");
		self.maySet = core.maySet;

		const field = () => $("#rrfmodel_network_host");

		self.keep = function () {
			const values = {host: field().val(), password: self.password()};
			core.command("network_password", values).done(() => {
				self.told(values.password ? gettext("Kept.") : gettext("Forgotten."));
				self.password("");
			});
		};

		self.onConnectionDataReceived = function (options) {
			const own = options && options[CONNECTOR];
			const known = ((own && own.host) || []).map(host => ({host: host, name: ""}));
			self.hosts(known.concat((own && own.found) || []));
		};

		/* without it the dialog of settings shows the parameters as they come */
		self.onRenderParametersForConnector = function (connector, given) {
			if (connector !== CONNECTOR) return false;
			return [{name: gettext("Address of the board"), value: (given && given.host) || ""}];
		};

		self.onReevaluateConnectionParameters = function (connector) {
			return connector === CONNECTOR ? Boolean((field().val() || "").trim()) : undefined;
		};
	}

	OCTOPRINT_VIEWMODELS.push({
		construct: RrfModelNetworkViewModel,
		dependencies: ["rrfModelViewModel"],
		elements: ["#connection_options_" + CONNECTOR]
	});
});
