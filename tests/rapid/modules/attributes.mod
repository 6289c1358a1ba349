! RAPID Kernel, Module declarations: attributes in parentheses behind the name.
MODULE attributes(SYSMODULE,NOSTEPIN,VIEWONLY)
  PROC main()
    TPWrite "attributes";               ! -> attributes
  ENDPROC
ENDMODULE

MODULE others(SYSMODULE,READONLY)
ENDMODULE

MODULE hidden_text(NOVIEW)
ENDMODULE
