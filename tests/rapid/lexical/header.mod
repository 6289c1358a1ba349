%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%
! RAPID Kernel, File header: %%% stands before MODULE; elsewhere % is late binding.
MODULE header
  PROC main()
    %"show"%;
  ENDPROC

  PROC show()
    TPWrite "shown";            ! -> shown
  ENDPROC
ENDMODULE
