/* Message boxes of the machine (M291). */
