! Field practice, Strings: messages for sockets and files end in \0D\0A.
MODULE strings_with_controls
  CONST string CRLF:="\0D\0A";
  CONST string quoted:="""";
  VAR rawbytes raw;
  VAR num n;

  PROC main()
    PackRawBytes "ok"+CRLF,raw,1\ASCII;
    UnpackRawBytes raw,4,n\Hex1;
    TPWrite ValToStr(n)+quoted;           ! -> 10"
    TPWrite "C:\\data!";                  ! -> C:\data!
  ENDPROC
ENDMODULE
