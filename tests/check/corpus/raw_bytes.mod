MODULE raw_bytes
  VAR rawbytes raw_data;
  VAR num x;
  VAR num y;
  VAR byte head:=0xFF;
  VAR iodev channel;
  PROC main()
    ClearRawBytes raw_data;
    PackRawBytes head,raw_data,1\Hex1;
    PackRawBytes 12.5,raw_data,RawBytesLen(raw_data)+1\Float4;
    PackRawBytes x,raw_data,6\IntX:=DINT;
    UnpackRawBytes raw_data\Network,2,y\Float4;
    Open "com1:",channel\Bin;
    WriteRawBytes channel,raw_data;
    Close channel;
  ENDPROC
ENDMODULE
