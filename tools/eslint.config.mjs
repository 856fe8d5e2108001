/* What the page's scripts may not have. Layout is Prettier's, so that no rule here is about it. */

/** What a browser, OctoPrint's page and the plugin's own core script bring. */
const GLOBALS = [
	..."window document navigator location localStorage sessionStorage console fetch URL".split(" "),
	..."setTimeout clearTimeout setInterval clearInterval requestAnimationFrame cancelAnimationFrame".split(" "),
	..."Blob FileReader FormData AbortController ResizeObserver MutationObserver IntersectionObserver".split(" "),
	..."performance getComputedStyle matchMedia Event CustomEvent KeyboardEvent Image Node Element HTMLElement".split(
		" "
	),
	..."$ _ ko gettext ngettext OctoPrint OctoPrintClient OCTOPRINT_VIEWMODELS PNotify RRFModel".split(" "),
	..."showConfirmationDialog copyToClipboard BASEURL AudioContext define".split(" ")
];

const RULES = [
	// mistakes
	..."constructor-super for-direction getter-return no-async-promise-executor no-class-assign".split(" "),
	..."no-compare-neg-zero no-const-assign no-constant-binary-expression no-constant-condition".split(" "),
	..."no-debugger no-dupe-args no-dupe-class-members no-dupe-else-if no-dupe-keys no-duplicate-case".split(" "),
	..."no-empty no-empty-pattern no-ex-assign no-fallthrough no-func-assign no-import-assign".split(" "),
	..."no-invalid-regexp no-irregular-whitespace no-loss-of-precision no-new-native-nonconstructor".split(" "),
	..."no-obj-calls no-prototype-builtins no-redeclare no-regex-spaces no-self-assign no-self-compare".split(" "),
	..."no-setter-return no-shadow-restricted-names no-sparse-arrays no-this-before-super no-undef".split(" "),
	..."no-unexpected-multiline no-unmodified-loop-condition no-unreachable no-unsafe-finally".split(" "),
	..."no-unsafe-negation no-unsafe-optional-chaining no-unused-labels no-useless-assignment no-useless-catch".split(
		" "
	),
	..."no-useless-catch no-useless-escape use-isnan valid-typeof array-callback-return".split(" "),
	// what runs text, or is blocked by whoever forbids that
	..."no-eval no-implied-eval no-new-func no-script-url no-alert".split(" "),
	// habits of the house
	..."eqeqeq no-var prefer-const no-implicit-globals no-throw-literal no-extend-native no-caller".split(" "),
	..."no-else-return no-lonely-if no-unneeded-ternary".split(" ")
];

export default [
	{
		files: ["octoprint_rrfmodel/static/**/*.js"],
		languageOptions: {
			ecmaVersion: 2018,
			sourceType: "script",
			globals: Object.fromEntries(GLOBALS.map(name => [name, "readonly"]))
		},
		linterOptions: {reportUnusedDisableDirectives: "error"},
		rules: {
			...Object.fromEntries(RULES.map(name => [name, "error"])),
			// ES2018 has no catch without a name
			"no-unused-vars": ["error", {caughtErrors: "none"}]
		}
	}
];
